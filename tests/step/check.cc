/* SPDX-License-Identifier: MIT */
/* Single role: reads a STEP file with Open CASCADE, as CAD programs do, and says what is in it.

   Usage: check FILE      Prints one line "name value" for each of
     solids shells faces edges   counts; shells are those outside solids; edges counted once
     valid                       1 where BRepCheck finds nothing wrong
     closed                      1 where every edge has two faces
     tolerance                   largest of vertices, edges and faces, in mm
     volume                      in mm^3, relative error 1e-8; without solids: between the faces and the origin
     area                        in mm^2
     gap normal curvature        across edges of two faces: largest distance of points, largest angle of normals in
                                 radians, largest difference of shape tensors (Frobenius norm) in relation to the largest principal curvature
     largest_curvature           the largest principal curvature met
     box                         six numbers: of the control points
     name                        of the product */
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepGProp_Domain.hxx>
#include <BRepGProp_Face.hxx>
#include <BRepGProp_Vinert.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <GeomLProp_SLProps.hxx>
#include <Geom2d_Curve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_ShapeTolerance.hxx>
#include <StepBasic_Product.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Standard_Failure.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedDataMapOfShapeListOfShape.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp.hxx>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

struct Tensor {
  double w[3][3];
};

/* Shape tensor J G^-1 B G^-1 J^T at a point of a face, with its outward normal, and the largest principal curvature. */
bool shape_tensor(const TopoDS_Face &face, const gp_Pnt2d &uv, gp_Pnt &point, gp_Vec &normal, Tensor &tensor,
                  double &largest) {
  TopLoc_Location location;
  Handle(Geom_Surface) surface = BRep_Tool::Surface(face, location);
  gp_Vec u, v, uu, vv, uv_;
  surface->D2(uv.X(), uv.Y(), point, u, v, uu, vv, uv_);
  if (!location.IsIdentity()) return false;
  normal = u.Crossed(v);
  if (normal.Magnitude() < 1e-30) return false;
  normal.Normalize();
  if (face.Orientation() == TopAbs_REVERSED) normal.Reverse();
  double g11 = u.Dot(u), g12 = u.Dot(v), g22 = v.Dot(v), det = g11 * g22 - g12 * g12;
  double h[2][2] = {{normal.Dot(uu), normal.Dot(uv_)}, {normal.Dot(uv_), normal.Dot(vv)}};
  /* rows of G^-1 J^T: the dual basis */
  gp_Vec dual[2] = {(u * g22 - v * g12) / det, (v * g11 - u * g12) / det};
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) {
      tensor.w[i][j] = 0;
      for (int a = 0; a < 2; a++)
        for (int b = 0; b < 2; b++) tensor.w[i][j] += dual[a].Coord(i + 1) * h[a][b] * dual[b].Coord(j + 1);
    }
  double trace = tensor.w[0][0] + tensor.w[1][1] + tensor.w[2][2], squares = 0;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) squares += tensor.w[i][j] * tensor.w[i][j];
  /* k1 + k2 = trace, k1^2 + k2^2 = squares */
  largest = std::fabs(trace) / 2 + std::sqrt(std::max(0., squares / 2 - trace * trace / 4));
  return true;
}

struct Contact {
  double gap = 0, normal = 0, curvature = 0, largest = 0;
};

void compare(const TopoDS_Edge &edge, const TopoDS_Face &a, const TopoDS_Face &b, Contact &contact) {
  enum { samples = 20 };
  double first[2], last[2];
  Handle(Geom2d_Curve) curve[2] = {BRep_Tool::CurveOnSurface(edge, a, first[0], last[0]),
                                   BRep_Tool::CurveOnSurface(edge, b, first[1], last[1])};
  double from, to;
  Handle(Geom_Curve) space_curve = BRep_Tool::Curve(edge, from, to);
  if (curve[0].IsNull() || curve[1].IsNull() || space_curve.IsNull()) throw Standard_Failure("an edge without curves");
  for (int k = 0; k <= samples; k++) {
    double t = from + (to - from) * k / samples, largest[2] = {0, 0}, difference = 0;
    gp_Pnt point[2];
    gp_Vec normal[2];
    Tensor tensor[2];
    bool good = shape_tensor(a, curve[0]->Value(t), point[0], normal[0], tensor[0], largest[0]) &&
                shape_tensor(b, curve[1]->Value(t), point[1], normal[1], tensor[1], largest[1]);
    if (!good) throw Standard_Failure("a point without a normal");
    gp_Pnt middle = space_curve->Value(t);
    contact.gap = std::max({contact.gap, point[0].Distance(point[1]), point[0].Distance(middle)});
    contact.normal = std::max(contact.normal, normal[0].Angle(normal[1]));
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) difference += std::pow(tensor[0].w[i][j] - tensor[1].w[i][j], 2);
    contact.curvature = std::max(contact.curvature, std::sqrt(difference));
    contact.largest = std::max({contact.largest, largest[0], largest[1]});
  }
}

int count(const TopoDS_Shape &shape, TopAbs_ShapeEnum kind, TopAbs_ShapeEnum outside) {
  int n = 0;
  for (TopExp_Explorer e(shape, kind, outside); e.More(); e.Next()) n++;
  return n;
}

void print_product(STEPControl_Reader &reader) {
  Handle(Interface_InterfaceModel) model = reader.WS()->Model();
  for (int i = 1; i <= model->NbEntities(); i++) {
    Handle(StepBasic_Product) product = Handle(StepBasic_Product)::DownCast(model->Value(i));
    if (!product.IsNull()) std::printf("name %s\n", product->Name()->ToCString());
  }
}

void print_box(const TopoDS_Shape &shape) {
  double min[3] = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, max[3] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    Handle(Geom_BSplineSurface) surface =
        Handle(Geom_BSplineSurface)::DownCast(BRep_Tool::Surface(TopoDS::Face(e.Current())));
    if (surface.IsNull()) throw Standard_Failure("a face that is no B-spline surface");
    for (int i = 1; i <= surface->NbUPoles(); i++)
      for (int j = 1; j <= surface->NbVPoles(); j++)
        for (int k = 0; k < 3; k++) {
          min[k] = std::min(min[k], surface->Pole(i, j).Coord(k + 1));
          max[k] = std::max(max[k], surface->Pole(i, j).Coord(k + 1));
        }
  }
  std::printf("box %.17g %.17g %.17g %.17g %.17g %.17g\n", min[0], min[1], min[2], max[0], max[1], max[2]);
}

void print_contacts(const TopoDS_Shape &shape) {
  TopTools_IndexedDataMapOfShapeListOfShape faces;
  Contact contact;
  bool closed = true;
  TopExp::MapShapesAndAncestors(shape, TopAbs_EDGE, TopAbs_FACE, faces);
  for (int i = 1; i <= faces.Extent(); i++) {
    const TopTools_ListOfShape &list = faces(i);
    TopoDS_Edge edge = TopoDS::Edge(faces.FindKey(i));
    if (list.Extent() > 2) throw Standard_Failure("an edge of more than two faces");
    closed = closed && list.Extent() == 2;
    if (list.Extent() == 2) compare(edge, TopoDS::Face(list.First()), TopoDS::Face(list.Last()), contact);
  }
  std::printf("edges %d\nclosed %d\ngap %.3g\nnormal %.3g\ncurvature %.3g\nlargest_curvature %.6g\n", faces.Extent(),
              closed ? 1 : 0, contact.gap, contact.normal,
              contact.largest > 0 ? contact.curvature / contact.largest : contact.curvature, contact.largest);
}

/* Of solids. Where there is none, of what lies between the faces and the origin: the reader's own sum would choose another
   point to look from. */
double volume_of(const TopoDS_Shape &shape) {
  const double eps = 1e-8;
  double sum = 0;
  for (TopExp_Explorer e(shape, TopAbs_SOLID); e.More(); e.Next()) {
    GProp_GProps volume;
    BRepGProp::VolumeProperties(e.Current(), volume, eps);
    sum += volume.Mass();
  }
  if (TopExp_Explorer(shape, TopAbs_SOLID).More()) return sum;
  for (TopExp_Explorer e(shape, TopAbs_FACE); e.More(); e.Next()) {
    BRepGProp_Face face(TopoDS::Face(e.Current()));
    BRepGProp_Vinert part;
    part.SetLocation(gp::Origin());
    BRepGProp_Domain domain(TopoDS::Face(e.Current()));
    part.Perform(face, domain, gp::Origin(), eps);
    sum += part.Mass();
  }
  return sum;
}

void check(const char *path) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path) != IFSelect_RetDone) throw Standard_Failure("the file cannot be read");
  int roots = reader.NbRootsForTransfer(), done = reader.TransferRoots();
  if (roots < 1 || done != roots) throw Standard_Failure("not everything in the file can be transferred");
  TopoDS_Shape shape = reader.OneShape();
  std::printf("solids %d\nshells %d\nfaces %d\n", count(shape, TopAbs_SOLID, TopAbs_SHAPE),
              count(shape, TopAbs_SHELL, TopAbs_SOLID), count(shape, TopAbs_FACE, TopAbs_SHAPE));
  print_product(reader);
  print_box(shape);
  std::printf("valid %d\n", BRepCheck_Analyzer(shape).IsValid() ? 1 : 0);
  std::printf("tolerance %.3g\n", ShapeAnalysis_ShapeTolerance().Tolerance(shape, 1));
  GProp_GProps area;
  BRepGProp::SurfaceProperties(shape, area, 1e-8);
  std::printf("volume %.15g\narea %.15g\n", volume_of(shape), area.Mass());
  print_contacts(shape);
}

} // namespace

int main(int argc, char **argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: check FILE\n");
    return 2;
  }
  try {
    check(argv[1]);
  } catch (const Standard_Failure &failure) {
    std::fprintf(stderr, "%s: %s\n", argv[1], failure.GetMessageString());
    return 1;
  }
  return 0;
}
