/* SPDX-License-Identifier: MIT */
/* Single role: how fast OpenSubdiv evaluates its Gregory end caps, on the mesh of ../gregory.c and at the same number of
   points per quad of the mesh; points on its regular patches are left out. Positions with first derivatives, in single
   precision, by the ways it has: basis functions of each point, and a whole buffer of points. Least of five runs. */
#include "../gregory_mesh.h"

#include <opensubdiv/far/patchMap.h>
#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/ptexIndices.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>
#include <opensubdiv/osd/cpuEvaluator.h>
#include <opensubdiv/osd/cpuPatchTable.h>
#include <opensubdiv/osd/cpuVertexBuffer.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <vector>

using namespace OpenSubdiv;

namespace {

enum { N_REPEATS = 5 };

double now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

struct Point {
  float x[3];
  void Clear(void * = nullptr) { x[0] = x[1] = x[2] = 0; }
  void AddWithWeight(const Point &other, float weight) {
    for (int k = 0; k < 3; k++) x[k] += weight * other.x[k];
  }
};

struct Coordinates {
  const Osd::PatchCoord *first;
  const Osd::PatchCoord *BindCpuBuffer() const { return first; }
};

Far::TopologyRefiner *make_refiner(const bench_mesh &mesh) {
  std::vector<int> sizes((size_t)mesh.n_quads, 4);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = mesh.n_vertices;
  descriptor.numFaces = mesh.n_quads;
  descriptor.numVertsPerFace = sizes.data();
  descriptor.vertIndicesPerFace = &mesh.corner[0][0];
  typedef Far::TopologyRefinerFactory<Far::TopologyDescriptor> Factory;
  return Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, Sdc::Options()));
}

void report(const char *title, size_t n, double seconds) {
  std::printf("%-42s %7.1f Mpoints/s %7.1f ns\n", title, 1e-6 * (double)n / seconds, 1e9 * seconds / (double)n);
}

void run(const bench_mesh &mesh, int level) {
  double start = now();
  Far::TopologyRefiner *refiner = make_refiner(mesh);
  Far::PatchTableFactory::Options options(level);
  options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
  refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
  Far::PatchTable *table = Far::PatchTableFactory::Create(*refiner, options);
  int n = refiner->GetNumVerticesTotal(), n_local = table->GetNumLocalPoints();
  std::vector<Point> point((size_t)(n + n_local));
  for (int v = 0; v < mesh.n_vertices; v++)
    for (int k = 0; k < 3; k++) point[(size_t)v].x[k] = (float)mesh.position[v][k];
  Far::PrimvarRefiner primvars(*refiner);
  Point *source = point.data();
  for (int k = 1; k <= refiner->GetMaxLevel(); k++) {
    Point *target = source + refiner->GetLevel(k - 1).GetNumVertices();
    primvars.Interpolate(k, source, target);
    source = target;
  }
  if (n_local > 0) table->ComputeLocalPointValues(&point[0], &point[(size_t)n]);
  double setup = now() - start;

  int n_gregory = 0, n_regular = 0;
  for (int a = 0; a < table->GetNumPatchArrays(); a++)
    (table->GetPatchArrayDescriptor(a).GetType() == Far::PatchDescriptor::GREGORY_BASIS ? n_gregory : n_regular) +=
        table->GetNumPatches(a);
  std::printf("OpenSubdiv, level %d: %d Gregory and %d regular patches, made in %.0f ms\n", level, n_gregory, n_regular,
              1e3 * setup);

  Far::PatchMap map(*table);
  Far::PtexIndices faces(*refiner);
  std::vector<Osd::PatchCoord> at;
  for (int f = 0; f < faces.GetNumFaces(); f++)
    for (int k = 0; k < BENCH_POINTS; k++) {
      double u, v;
      bench_parameters(k, &u, &v);
      const Far::PatchTable::PatchHandle *handle = map.FindPatch(f, u, v);
      if (table->GetPatchDescriptor(*handle).GetType() == Far::PatchDescriptor::GREGORY_BASIS)
        at.push_back(Osd::PatchCoord(*handle, (float)u, (float)v));
    }
  if (at.empty()) return;

  double by_point = 1e9, by_buffer = 1e9, sum = 0;
  for (int i = 0; i < N_REPEATS; i++) {
    start = now();
    for (const Osd::PatchCoord &coord : at) {
      float w[20], wu[20], wv[20];
      Point p, pu, pv;
      table->EvaluateBasis(coord.handle, coord.s, coord.t, w, wu, wv);
      Far::ConstIndexArray control = table->GetPatchVertices(coord.handle);
      p.Clear(), pu.Clear(), pv.Clear();
      for (int k = 0; k < control.size(); k++) {
        const Point &q = point[(size_t)control[k]];
        p.AddWithWeight(q, w[k]), pu.AddWithWeight(q, wu[k]), pv.AddWithWeight(q, wv[k]);
      }
      sum += p.x[0] + pu.x[1] + pv.x[2];
    }
    by_point = std::min(by_point, now() - start);
  }
  report("  positions, first derivatives, one by one", at.size(), by_point);

  Osd::CpuPatchTable *cpu = Osd::CpuPatchTable::Create(table);
  Osd::CpuVertexBuffer *in = Osd::CpuVertexBuffer::Create(3, n + n_local), *out[3];
  Osd::BufferDescriptor layout(0, 3, 3);
  Coordinates coordinates = {at.data()};
  in->UpdateData(&point[0].x[0], 0, n + n_local);
  for (int k = 0; k < 3; k++) out[k] = Osd::CpuVertexBuffer::Create(3, (int)at.size());
  for (int i = 0; i < N_REPEATS; i++) {
    start = now();
    Osd::CpuEvaluator::EvalPatches(in, layout, out[0], layout, out[1], layout, out[2], layout, (int)at.size(),
                                   &coordinates, cpu);
    by_buffer = std::min(by_buffer, now() - start);
  }
  report("  positions, first derivatives, buffer", at.size(), by_buffer);
  for (int k = 0; k < 3; k++) delete out[k];
  delete in;
  delete cpu;
  delete table;
  delete refiner;
  if (!(sum == sum)) std::printf("not finite\n");
}

} // namespace

int main() {
  bench_mesh mesh = bench_make_mesh();
  run(mesh, 0);
  run(mesh, 1);
  std::free(mesh.position);
  std::free(mesh.corner);
  return 0;
}
