/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between MeshLab's types and layers, the same for all releases: to be included after MeshLab's own headers. Nothing of a mesh
   is changed before the library's work has succeeded. */
#ifndef FS_MESHLAB_BORDER_H
#define FS_MESHLAB_BORDER_H

#include <QFileInfo>
#include <QStringList>

#include <algorithm>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <vcg/complex/algorithms/update/bounding.h>
#include <vcg/complex/algorithms/update/color.h>
#include <vcg/complex/algorithms/update/normal.h>

#include "formats.h"

namespace fairsurf {

/* ---- a call of the library ---------------------------------------------------------------------------------------- */

/* A context whose progress goes to MeshLab's callback; its false stops the work. callback may be null. */
class Context : public fs_context {
public:
  explicit Context(vcg::CallBackPos *callback) : fs_context{}, callback_(callback) {
    progress = go_on;
    user = this;
    n_threads = std::max(1, std::min(64, int(std::thread::hardware_concurrency())));
    fs_blas_set_threads(1); // small systems: threads of the BLAS would wait for each other
  }
  ~Context() { fs_context_clear(this); }
  Context(const Context &) = delete;
  Context &operator=(const Context &) = delete;

private:
  static bool go_on(void *user, const char *stage, double fraction) {
    vcg::CallBackPos *callback = static_cast<Context *>(user)->callback_;
    return callback == nullptr || callback(int(100 * fraction), stage);
  }
  vcg::CallBackPos *callback_;
};

struct LayerOwner : layer {
  LayerOwner() : layer{} {}
  ~LayerOwner() { layer_clear(this); }
  LayerOwner(const LayerOwner &) = delete;
  LayerOwner &operator=(const LayerOwner &) = delete;
};
struct OutcomeOwner : outcome {
  OutcomeOwner() : outcome{} {}
  ~OutcomeOwner() { outcome_clear(this); }
  OutcomeOwner(const OutcomeOwner &) = delete;
  OutcomeOwner &operator=(const OutcomeOwner &) = delete;
};

/* ---- parameters ----------------------------------------------------------------------------------------------------- */

inline QStringList choices(const filter_param &p) {
  QStringList names;
  for (int i = 0; param_choice(&p, i) != nullptr; i++) names << param_choice(&p, i);
  return names;
}

template <class List> void addParams(const filter_param *params, List &list) {
  for (const filter_param *p = params; p->name != nullptr; p++) switch (p->kind) {
    case PARAM_INTEGER:
      list.addParam(RichInt(p->name, int(p->initial), p->label, p->help));
      break;
    case PARAM_NUMBER:
      list.addParam(RichFloat(p->name, float(p->initial), p->label, p->help));
      break;
    case PARAM_SLIDER:
      list.addParam(RichDynamicFloat(p->name, float(p->initial), float(p->min), float(p->max), p->label, p->help));
      break;
    case PARAM_SWITCH:
      list.addParam(RichBool(p->name, p->initial != 0, p->label, p->help));
      break;
    case PARAM_CHOICE:
      list.addParam(RichEnum(p->name, int(p->initial), choices(*p), p->label, p->help));
      break;
    }
}

/* MeshLab's numbers have single precision: 0.1f is taken for the 0.1 that was typed. */
inline double asTyped(double single) { return QString::number(single, 'g', 7).toDouble(); }

/* Values in the order of params; those that the list does not have are the initial ones. */
template <class List> std::vector<double> readParams(const filter_param *params, const List &list) {
  std::vector<double> value;
  for (const filter_param *p = params; p->name != nullptr; p++) {
    double v = p->initial;
    if (list.hasParameter(p->name)) switch (p->kind) {
      case PARAM_INTEGER:
        v = list.getInt(p->name);
        break;
      case PARAM_NUMBER:
        v = asTyped(list.getFloat(p->name));
        break;
      case PARAM_SLIDER:
        v = asTyped(list.getDynamicFloat(p->name));
        break;
      case PARAM_SWITCH:
        v = list.getBool(p->name);
        break;
      case PARAM_CHOICE:
        v = list.getEnum(p->name);
        break;
      }
    value.push_back(v);
  }
  return value;
}

/* ---- from MeshLab --------------------------------------------------------------------------------------------------- */

enum { NO_VERTEX = -1 };

/* number[i]: of vertex i of the mesh in the layer; NO_VERTEX where it was deleted or no face has it. A mesh without faces
   keeps its vertices, and the library says what is missing. */
inline std::vector<int32_t> numberVertices(const CMeshO &mesh, int32_t &n) {
  std::vector<int32_t> number(mesh.vert.size(), NO_VERTEX);
  for (const auto &face : mesh.face)
    if (!face.IsD())
      for (int k = 0; k < 3; k++) number[vcg::tri::Index(mesh, face.cV(k))] = 0;
  n = 0;
  for (size_t i = 0; i < number.size(); i++)
    if (!mesh.vert[i].IsD() && (number[i] == 0 || mesh.fn == 0)) number[i] = n++;
  return number;
}

/* Fills a layer; number: as numberVertices has it. */
inline fs_status takeLayer(fs_context *ctx, const CMeshO &mesh, LayerOwner &l, std::vector<int32_t> &number) {
  number = numberVertices(mesh, l.polygons.n_vertices);
  l.polygons.position = static_cast<fs_vec3 *>(take(ctx, size_t(l.polygons.n_vertices), sizeof(fs_vec3)));
  l.selected = static_cast<bool *>(take(ctx, size_t(l.polygons.n_vertices), sizeof(bool)));
  if (l.polygons.position == nullptr || l.selected == nullptr) return FS_ERR_MEMORY;
  for (size_t i = 0; i < number.size(); i++)
    if (number[i] != NO_VERTEX) {
      const auto &p = mesh.vert[i].cP();
      l.polygons.position[number[i]] = {double(p[0]), double(p[1]), double(p[2])};
      l.selected[number[i]] = mesh.vert[i].IsS();
    }
  std::vector<int32_t> triangle;
  std::vector<uint8_t> faux;
  for (const auto &face : mesh.face)
    if (!face.IsD()) {
      uint8_t bits = 0;
      for (int k = 0; k < 3; k++) {
        triangle.push_back(number[vcg::tri::Index(mesh, face.cV(k))]);
        bits |= uint8_t(face.IsF(k) ? 1u << k : 0u);
        if (face.IsS()) l.selected[triangle.back()] = true;
      }
      faux.push_back(bits);
    }
  l.n_selected = int32_t(std::count(l.selected, l.selected + l.polygons.n_vertices, true));
  return polygons_join(ctx, int32_t(faux.size()), triangle.data(), faux.data(), &l.polygons);
}

/* ---- to MeshLab ----------------------------------------------------------------------------------------------------- */

template <class Point> Point toPoint(const fs_vec3 &p) {
  using Scalar = typename Point::ScalarType;
  return Point(Scalar(p.x), Scalar(p.y), Scalar(p.z));
}

/* Normals as MeshLab makes them after it has read a file. */
inline void updateNormals(MeshModel &model) {
  if (model.hasDataMask(MeshModel::MM_POLYGONAL)) {
    model.updateDataMask(MeshModel::MM_FACEFACETOPO);
    vcg::tri::UpdateNormal<CMeshO>::PerBitQuadFaceNormalized(model.cm);
    vcg::tri::UpdateNormal<CMeshO>::PerVertexFromCurrentFaceNormal(model.cm);
  } else {
    vcg::tri::UpdateNormal<CMeshO>::PerFaceNormalized(model.cm);
    vcg::tri::UpdateNormal<CMeshO>::PerVertexAngleWeighted(model.cm);
  }
  vcg::tri::UpdateNormal<CMeshO>::NormalizePerVertex(model.cm);
  vcg::tri::UpdateBounding<CMeshO>::Box(model.cm);
}

/* Triangles of polygons, from malloc. */
struct Triangles {
  int32_t n = 0;
  int32_t *corner = nullptr;
  uint8_t *faux = nullptr;
  ~Triangles() { free(corner), free(faux); }
};

inline void putFaces(const outcome &o, const Triangles &t, MeshModel &model) {
  CMeshO &mesh = model.cm;
  mesh.Clear();
  vcg::tri::Allocator<CMeshO>::AddVertices(mesh, size_t(o.polygons.n_vertices));
  vcg::tri::Allocator<CMeshO>::AddFaces(mesh, size_t(t.n));
  bool hasPolygons = false;
  for (int32_t i = 0; i < t.n; i++)
    for (int k = 0; k < 3; k++) {
      mesh.face[i].V(k) = &mesh.vert[t.corner[3 * i + k]];
      if (t.faux[i] >> k & 1) mesh.face[i].SetF(k), hasPolygons = true;
    }
  if (hasPolygons)
    model.updateDataMask(MeshModel::MM_POLYGONAL);
  else
    model.clearDataMask(MeshModel::MM_POLYGONAL);
}

inline void putVertices(const outcome &o, const std::vector<int32_t> &number, MeshModel &model) {
  CMeshO &mesh = model.cm;
  if (o.quality != nullptr) model.updateDataMask(MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR);
  for (size_t i = 0; i < number.size(); i++) {
    if (number[i] == NO_VERTEX) continue;
    if (o.polygons.n_vertices > 0) mesh.vert[i].P() = toPoint<CMeshO::CoordType>(o.polygons.position[number[i]]);
    if (o.quality != nullptr) mesh.vert[i].Q() = CMeshO::ScalarType(o.quality[number[i]]);
  }
  if (o.polygons.n_vertices > 0) updateNormals(model);
  if (o.normal != nullptr)
    for (size_t i = 0; i < number.size(); i++)
      if (number[i] != NO_VERTEX) mesh.vert[i].N() = toPoint<CMeshO::CoordType>(o.normal[number[i]]);
  if (o.quality != nullptr)
    vcg::tri::UpdateColor<CMeshO>::PerVertexQualityRamp(mesh, CMeshO::ScalarType(o.low), CMeshO::ScalarType(o.high));
}

/* Hides a layer that would cover the result. In 2020.09 the window alone knows which layers are seen, and no filter reaches it. */
inline void hide(MeshModel *model) {
#if FS_MESHLAB_GENERATION >= 2021
  model->setVisible(false);
#else
  (void)model;
#endif
}

/* Writes back what a filter made. */
inline fs_status putOutcome(fs_context *ctx, const outcome &o, std::vector<int32_t> number, MeshDocument &document) {
  MeshModel *model = document.mm();
  if (o.polygons.n_faces == 0) {
    putVertices(o, number, *model);
    return FS_OK;
  }
  Triangles t;
  fs_status status = polygons_split(ctx, &o.polygons, &t.n, &t.corner, &t.faux);
  if (status != FS_OK) return status;
  number.resize(size_t(o.polygons.n_vertices));
  for (int32_t i = 0; i < o.polygons.n_vertices; i++) number[size_t(i)] = i;
  if (o.in_new_layer) {
    MeshModel *source = model;
    // the list of layers shows a name up to its first dot
    QString name = QFileInfo(source->label()).completeBaseName() + " " + o.suffix;
    model = document.addNewMesh("", name, true);
    model->cm.Tr = source->cm.Tr;
    hide(source);
  }
  putFaces(o, t, *model);
  putVertices(o, number, *model);
  return FS_OK;
}

/* ---- whole jobs ------------------------------------------------------------------------------------------------------ */

/* Runs a filter on the current layer. Returns the sentence that says what went wrong, empty where all is well; log: lines for
   the user. No exception leaves it. */
template <class List>
std::string applyFilter(const filter &f, const List &list, MeshDocument &document, vcg::CallBackPos *callback,
                        OutcomeOwner &made) try {
  Context ctx(callback);
  LayerOwner l;
  std::vector<int32_t> number;
  if (document.mm() == nullptr) return "there is no layer";
  fs_status status = takeLayer(&ctx, document.mm()->cm, l, number);
  if (status == FS_OK) status = filter_run(&ctx, &f, &l, readParams(f.params, list).data(), &made);
  if (status == FS_OK) status = putOutcome(&ctx, made, number, document);
  return status == FS_OK ? std::string() : ctx.message;
} catch (const std::exception &e) {
  return e.what();
} catch (...) {
  return "an unknown exception";
}

/* Writes a mesh into a file; likewise. */
template <class List>
std::string save(const QString &format, const QString &path, const CMeshO &mesh, const List &list,
                 vcg::CallBackPos *callback) try {
  Context ctx(callback);
  LayerOwner l;
  std::vector<int32_t> number;
  filter_param params[MAX_FORMAT_PARAMS];
  const fs_exporter *exporter = format_find(format.toUtf8().constData());
  if (exporter == nullptr) return "there is no format of this name";
  format_list_params(exporter, params);
  fs_status status = takeLayer(&ctx, mesh, l, number);
  if (status == FS_OK)
    status = format_write(&ctx, exporter, &l, readParams(params, list).data(), QFile::encodeName(path).constData());
  return status == FS_OK ? std::string() : ctx.message;
} catch (const std::exception &e) {
  return e.what();
} catch (...) {
  return "an unknown exception";
}

} // namespace fairsurf

#endif
