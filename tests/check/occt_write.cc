/* SPDX-License-Identifier: MIT */
/* Single role: STEP files as Open CASCADE writes them, for the reader of surfaces.

   Usage: occt_write again IN OUT      reads a file and writes its shapes again
          occt_write bspline OUT       one face through the points (x, y, sin x cos y) of a grid on [0, 2] x [0, 1]
          occt_write cylinder OUT      a solid with plane and cylindrical faces
          occt_write rational OUT      the same, all faces made rational B-spline surfaces
          occt_write trimmed OUT       part of that B-spline face, cut off by a plane
   Prints the area. */
#include <BRepAlgoAPI_Common.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <GProp_GProps.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS_Shape.hxx>

#include <cmath>
#include <cstdio>
#include <cstring>

namespace {

TopoDS_Shape read(const char *path) {
  STEPControl_Reader reader;
  if (reader.ReadFile(path) != IFSelect_RetDone) throw Standard_Failure("the file cannot be read");
  reader.TransferRoots();
  return reader.OneShape();
}

TopoDS_Shape bspline() {
  TColgp_Array2OfPnt points(1, 9, 1, 7);
  for (int i = 1; i <= 9; i++)
    for (int j = 1; j <= 7; j++) {
      double x = 2. * (i - 1) / 8, y = (j - 1) / 6.;
      points.SetValue(i, j, gp_Pnt(x, y, std::sin(x) * std::cos(y)));
    }
  Handle(Geom_BSplineSurface) surface = GeomAPI_PointsToBSplineSurface(points, 3, 8, GeomAbs_C2, 1e-6).Surface();
  return BRepBuilderAPI_MakeFace(surface, 1e-6).Shape();
}

TopoDS_Shape make(const char *what, const char *in) {
  if (std::strcmp(what, "again") == 0) return read(in);
  if (std::strcmp(what, "bspline") == 0) return bspline();
  if (std::strcmp(what, "cylinder") == 0) return BRepPrimAPI_MakeCylinder(1, 2).Shape();
  if (std::strcmp(what, "rational") == 0)
    return BRepBuilderAPI_NurbsConvert(BRepPrimAPI_MakeCylinder(1, 2).Shape(), Standard_True).Shape();
  if (std::strcmp(what, "trimmed") == 0)
    return BRepAlgoAPI_Common(bspline(), BRepPrimAPI_MakeBox(gp_Pnt(-1, -1, -5), gp_Pnt(1.3, 3, 5)).Shape()).Shape();
  throw Standard_Failure("unknown kind of file");
}

} // namespace

int main(int argc, char **argv) {
  bool is_again = argc == 4 && std::strcmp(argv[1], "again") == 0;
  if (argc != 3 && !is_again) {
    std::fprintf(stderr, "usage: occt_write again IN OUT | bspline OUT | cylinder OUT | rational OUT | trimmed OUT\n");
    return 2;
  }
  try {
    TopoDS_Shape shape = make(argv[1], argv[2]);
    STEPControl_Writer writer;
    GProp_GProps area;
    if (writer.Transfer(shape, STEPControl_AsIs) != IFSelect_RetDone ||
        writer.Write(argv[argc - 1]) != IFSelect_RetDone)
      throw Standard_Failure("the file cannot be written");
    BRepGProp::SurfaceProperties(shape, area, 1e-9);
    std::printf("area %.12g\n", area.Mass());
  } catch (const Standard_Failure &failure) {
    std::fprintf(stderr, "%s\n", failure.GetMessageString());
    return 1;
  }
  return 0;
}
