/* SPDX-License-Identifier: MIT */
/* Single role: jumps across the edges of OpenSubdiv's limit surface, by the measure that check uses, beside those of our
   surface over the same mesh. The table in docs/measures.md comes from here.

   Usage: osd_jumps MESH...     quadrilaterals; edges at the boundary are left out
   OpenSubdiv approximates the limit surface around special vertices by Gregory patches after some levels of refinement: 2 is
   its default. Its edges are sampled from 0.5 % to 99.5 % of their length: curvatures grow without bound
   towards special vertices of valence above 4. Third derivatives it does not give. */
#include <fairsurf/fairsurf.h>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

using namespace OpenSubdiv;

namespace {

typedef Bfr::Surface<double> Surface;

/* One face of the limit surface. */
struct Face {
  Surface surface;
  std::vector<double> points;
};

/* An edge from corner `corner` of its face on, in its direction or against it. */
struct Side {
  Face *face;
  int corner;
  bool isForward;
};

struct Edge {
  Side side[2];
  double largest_H; /* of both faces along the edge */
  double jump_H;
};

fs_vec3 vector(const double *x) { return fs_vec3{x[0], x[1], x[2]}; }

void evaluate_side(const Side &s, double t, fs_vec3 *x) {
  static const double corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  double along = s.isForward ? t : 1 - t, uv[2], p[6][3];
  for (int k = 0; k < 2; k++)
    uv[k] = corner[s.corner][k] + along * (corner[(s.corner + 1) % 4][k] - corner[s.corner][k]);
  s.face->surface.Evaluate(uv, s.face->points.data(), 3, p[0], p[1], p[2], p[3], p[4], p[5]);
  for (int k = 0; k < 6; k++) x[k] = vector(p[k]);
  for (int k = 6; k < FS_JET_SIZE; k++) x[k] = fs_vec3{NAN, NAN, NAN};
}

void evaluate(void *user, double t, fs_vec3 *x, fs_vec3 *y) {
  static const fs_measure *mean = fs_measure_find("mean");
  Edge *edge = static_cast<Edge *>(user);
  double s = 0.005 + 0.99 * t;
  evaluate_side(edge->side[0], s, x);
  evaluate_side(edge->side[1], s, y);
  double H = mean->value(nullptr, x), other = mean->value(nullptr, y);
  edge->largest_H = std::fmax(edge->largest_H, std::fmax(std::fabs(H), std::fabs(other)));
  edge->jump_H = std::fmax(edge->jump_H, std::fabs(H - other));
}

struct Result {
  double jump[FS_N_JUMPS] = {0, 0, 0, 0}, largest_curvature = 0;
  double jump_H = 0, largest_H = 0; /* on the edges at special vertices */
};

void print(const char *name, const Result &r) {
  std::printf("  %-22s gap %8.1e  angle %8.1e  curvature %8.3g %%", name, r.jump[FS_JUMP_POSITION],
              r.jump[FS_JUMP_NORMAL], 100 * r.jump[FS_JUMP_CURVATURE]);
  if (r.largest_H > 0) std::printf("  mean curvature at the special vertex %8.3g %%", 100 * r.jump_H / r.largest_H);
  std::printf("\n");
}

bool is_special(const fs_mesh *mesh, int32_t v) {
  return !fs_mesh_is_boundary(mesh, v) && fs_mesh_valence(mesh, v) != 4;
}

Result measure_osd(const fs_mesh *mesh, int level) {
  std::vector<int> size(mesh->n_faces, 4), corner(mesh->origin, mesh->origin + mesh->n_halfedges);
  Far::TopologyDescriptor d;
  d.numVertices = mesh->n_vertices, d.numFaces = mesh->n_faces;
  d.numVertsPerFace = size.data(), d.vertIndicesPerFace = corner.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
  std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(d, Factory::Options(Sdc::SCHEME_CATMARK, options)));
  Bfr::SurfaceFactory::Options surface_options;
  surface_options.SetApproxLevelSmooth(level);
  surface_options.SetApproxLevelSharp(level);
  Bfr::RefinerSurfaceFactory<> surfaces(*refiner, surface_options);
  std::vector<Face> face(mesh->n_faces);
  for (int f = 0; f < mesh->n_faces; f++) {
    if (!surfaces.InitVertexSurface(f, &face[f].surface)) continue;
    face[f].points.resize(3 * (size_t)face[f].surface.GetNumPatchPoints());
    face[f].surface.PreparePatchPoints(&mesh->position[0].x, 3, face[f].points.data(), 3);
  }
  Result r;
  for (int32_t h = 0; h < mesh->n_halfedges; h++) {
    int32_t twin = mesh->twin[h], a = mesh->origin[h], b = fs_mesh_target(mesh, h);
    if (twin == FS_NONE || twin < h || fs_mesh_is_boundary(mesh, a) || fs_mesh_is_boundary(mesh, b)) continue;
    int32_t f = mesh->face[h], g = mesh->face[twin];
    Edge edge = {{{&face[f], h - mesh->face_start[f], true}, {&face[g], twin - mesh->face_start[g], false}}, 0, 0};
    fs_line line = {evaluate, &edge, false, 33};
    fs_line_jumps jumps;
    fs_line_largest(&line, 1e-6, &jumps);
    for (int k = 0; k < FS_N_JUMPS; k++) r.jump[k] = std::fmax(r.jump[k], jumps.value[k]);
    r.largest_curvature = std::fmax(r.largest_curvature, jumps.largest_curvature);
    if (!is_special(mesh, a) && !is_special(mesh, b)) continue;
    r.jump_H = std::fmax(r.jump_H, edge.jump_H);
    r.largest_H = std::fmax(r.largest_H, edge.largest_H);
  }
  r.jump[FS_JUMP_CURVATURE] /= r.largest_curvature;
  return r;
}

fs_status measure_ours(fs_context *ctx, const fs_mesh *mesh, Result *r) {
  fs_refinement *step[FS_MAX_REFINEMENTS];
  int32_t n_steps = 0;
  fs_space *space = nullptr;
  fs_surface *surface = nullptr;
  fs_edges *edges = nullptr;
  fs_continuity *c = nullptr;
  fs_status status = fs_space_prepare(ctx, mesh, 0, step, &n_steps);
  if (status == FS_OK) status = fs_space_create(ctx, n_steps > 0 ? step[n_steps - 1]->mesh : mesh, &space);
  if (status == FS_OK) status = fs_surface_create(ctx, space, space->start, &surface);
  if (status == FS_OK) status = fs_edges_create(ctx, surface, 0, &edges);
  if (status == FS_OK) status = fs_continuity_measure(ctx, surface, edges, nullptr, &c);
  for (int k = 0; k < FS_N_JUMPS && status == FS_OK; k++) r->jump[k] = c->max[k];
  fs_continuity_free(ctx, c);
  fs_edges_free(ctx, edges);
  fs_surface_free(ctx, surface);
  fs_space_free(ctx, space);
  for (int32_t i = 0; i < n_steps; i++) fs_refinement_free(ctx, step[i]);
  return status;
}

} // namespace

int main(int argc, char **argv) {
  fs_context ctx = {};
  int code = 0;
  for (int i = 1; i < argc; i++) {
    fs_mesh *mesh = nullptr;
    Result ours;
    bool is_quads = true;
    fs_status status = fs_mesh_read(&ctx, argv[i], &mesh);
    for (int32_t f = 0; status == FS_OK && f < mesh->n_faces; f++)
      is_quads = is_quads && fs_mesh_face_size(mesh, f) == 4;
    if (status == FS_OK) status = measure_ours(&ctx, mesh, &ours);
    if (status != FS_OK || !is_quads) {
      std::fprintf(stderr, "%s: %s\n", argv[i], is_quads ? ctx.message : "a face is no quadrilateral");
      code = 1;
    } else {
      std::printf("%s\n", argv[i]);
      print("fairsurf", ours);
      for (int level : {1, 2, 4, 6}) {
        char name[40];
        std::snprintf(name, sizeof name, "OpenSubdiv, level %d", level);
        print(name, measure_osd(mesh, level));
      }
    }
    fs_mesh_free(&ctx, mesh);
  }
  fs_context_clear(&ctx);
  return code;
}
