/* SPDX-License-Identifier: MIT */
/* Single role: CGAL's fairing (a linear problem, continuity 2) of the sheet that bench/fair.c has: cgal_fair [SIDE…]. */
#include "../fair_run.h"

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <sys/resource.h>
#include <vector>

using surface_mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;

static double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void measure(int n) {
  fs_context ctx = {};
  fs_mesh *sheet = bench_make_sheet(&ctx, n);
  int side = n + 2 * BENCH_RIM;
  surface_mesh mesh;
  std::vector<surface_mesh::Vertex_index> vertex, free_vertices;
  rusage usage;
  for (int v = 0; v < sheet->n_vertices; v++) {
    const fs_vec3 &p = sheet->position[v];
    int i = v % side, j = v / side;
    vertex.push_back(mesh.add_vertex({p.x, p.y, p.z}));
    if (i >= BENCH_RIM && i < side - BENCH_RIM && j >= BENCH_RIM && j < side - BENCH_RIM)
      free_vertices.push_back(vertex.back());
  }
  for (int j = 0; j + 1 < side; j++)
    for (int i = 0; i + 1 < side; i++) {
      int v = j * side + i;
      mesh.add_face(vertex[v], vertex[v + 1], vertex[v + 1 + side]);
      mesh.add_face(vertex[v], vertex[v + 1 + side], vertex[v + side]);
    }
  fs_mesh_free(&ctx, sheet);
  double begin = processor_seconds();
  bool is_done = CGAL::Polygon_mesh_processing::fair(mesh, free_vertices, CGAL::parameters::fairing_continuity(2));
  double seconds = processor_seconds() - begin;
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%7zu free  CGAL fair %7.3f s  peak %6.0f MB%s\n", free_vertices.size(), seconds,
              1e-3 * (double)usage.ru_maxrss, is_done ? "" : "  failed");
  std::fflush(stdout);
}

int main(int argc, char **argv) {
  if (argc == 1) measure(32);
  for (int i = 1; i < argc; i++) measure(std::atoi(argv[i]));
  return EXIT_SUCCESS;
}
