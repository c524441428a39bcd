/* SPDX-License-Identifier: MIT */
/* Single role: calls of the Draco library, behind functions of C. Every function that may throw catches; what the library
   decodes is checked before it is handed on, since it believes some indices of damaged files. */
#include <draco/compression/decode.h>
#include <draco/compression/expert_encode.h>
#include <draco/mesh/mesh.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "mesh/draco_bridge.h"
extern "C" {
#include "base/base.h"
}

struct fs_draco_mesh {
  std::unique_ptr<draco::Mesh> mesh;
  std::vector<uint8_t> text; /* of the entry that was asked for last */
};

namespace {

constexpr draco::GeometryAttribute::Type kinds[] = {
    draco::GeometryAttribute::POSITION, draco::GeometryAttribute::NORMAL, draco::GeometryAttribute::TEX_COORD,
    draco::GeometryAttribute::GENERIC};

/* Runs a body that may throw; a failure becomes a status and a sentence. */
template <typename Body> fs_status guard(fs_context *ctx, const char *verb, Body body) noexcept {
  try {
    return body();
  } catch (const std::bad_alloc &) {
    return fs_fail(ctx, FS_ERR_MEMORY, "out of memory");
  } catch (const std::exception &e) {
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco library cannot %s: %.120s", verb, e.what());
  } catch (...) {
    return fs_fail(ctx, FS_ERR_FORMAT, "the Draco library cannot %s", verb);
  }
}

/* ---- to bytes ---- */

int add_attribute(draco::Mesh &mesh, const fs_draco_attribute &a) {
  const draco::DataType type = a.is_byte ? draco::DT_UINT8 : draco::DT_FLOAT32;
  const size_t stride = a.n_components * (a.is_byte ? sizeof(uint8_t) : sizeof(float));
  draco::GeometryAttribute shape;
  shape.Init(kinds[a.kind], nullptr, static_cast<uint8_t>(a.n_components), type, false, stride, 0);
  const int id = mesh.AddAttribute(shape, a.value_of_point == nullptr, a.n_values);
  draco::PointAttribute *attribute = mesh.attribute(id);
  for (int32_t i = 0; i < a.n_values; i++)
    attribute->SetAttributeValue(draco::AttributeValueIndex(i), static_cast<const char *>(a.values) + i * stride);
  if (a.value_of_point != nullptr)
    for (uint32_t p = 0; p < mesh.num_points(); p++)
      attribute->SetPointMapEntry(draco::PointIndex(p), draco::AttributeValueIndex(a.value_of_point[p]));
  if (a.name != nullptr) {
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", a.name);
    mesh.AddAttributeMetadata(id, std::move(metadata));
  }
  return id;
}

void fill(draco::Mesh &mesh, const fs_draco_geometry &g) {
  mesh.set_num_points(g.n_points);
  mesh.SetNumFaces(g.n_triangles);
  for (int32_t t = 0; t < g.n_triangles; t++) {
    draco::Mesh::Face face;
    for (int c = 0; c < 3; c++) face[c] = g.corner[3 * (size_t)t + c];
    mesh.SetFace(draco::FaceIndex(t), face);
  }
  if (g.n_entries > 0) {
    auto metadata = std::make_unique<draco::GeometryMetadata>();
    for (int32_t i = 0; i < g.n_entries; i++) {
      const fs_draco_entry &e = g.entry[i];
      if (e.size > 0)
        metadata->AddEntryBinary(e.key, std::vector<uint8_t>(e.text, e.text + e.size));
      else
        metadata->AddEntryString(e.key, e.text);
    }
    mesh.AddMetadata(std::move(metadata));
  }
}

/* ---- from bytes ---- */

/* Indices in range, and values that are there. */
const char *find_damage(const draco::Mesh &mesh) {
  if (mesh.num_faces() == 0 || mesh.num_points() == 0) return "there are no triangles";
  for (uint32_t t = 0; t < mesh.num_faces(); t++)
    for (int c = 0; c < 3; c++)
      if (mesh.face(draco::FaceIndex(t))[c].value() >= mesh.num_points()) return "a corner is no point";
  for (int i = 0; i < mesh.num_attributes(); i++) {
    const draco::PointAttribute *a = mesh.attribute(i);
    if (a->num_components() == 0 || a->num_components() > INT8_MAX) return "an attribute has too many components";
    if (a->buffer() == nullptr || a->byte_offset() != 0 || a->size() > INT32_MAX ||
        a->buffer()->data_size() < a->size() * static_cast<size_t>(a->byte_stride()))
      return "values of an attribute are missing";
    if (!a->is_mapping_identity() && a->indices_map_size() < mesh.num_points()) return "points without values";
    for (uint32_t p = 0; p < mesh.num_points(); p++)
      if (a->mapped_index(draco::PointIndex(p)).value() >= a->size()) return "a point without value";
  }
  return nullptr;
}

} // namespace

extern "C" {

fs_status fs_draco_encode(fs_context *ctx, const fs_draco_geometry *g, int32_t *id, char **bytes, size_t *size) {
  return guard(ctx, "write this", [&]() -> fs_status {
    draco::Mesh mesh;
    fill(mesh, *g);
    std::vector<int> number;
    for (int32_t i = 0; i < g->n_attributes; i++) number.push_back(add_attribute(mesh, g->attribute[i]));
    draco::ExpertEncoder encoder(mesh);
    encoder.SetSpeedOptions(0, 0); /* the smallest files */
    encoder.SetEncodingMethod(draco::MESH_EDGEBREAKER_ENCODING);
    for (int32_t i = 0; i < g->n_attributes; i++) {
      const fs_draco_attribute &a = g->attribute[i];
      if (a.bits <= 0) continue;
      if (a.grid != nullptr)
        encoder.SetAttributeExplicitQuantization(number[i], a.bits, a.n_components, a.grid, a.grid[3]);
      else
        encoder.SetAttributeQuantization(number[i], a.bits);
    }
    draco::EncoderBuffer buffer;
    const draco::Status made = encoder.EncodeToBuffer(&buffer);
    if (!made.ok())
      return fs_fail(ctx, FS_ERR_NUMERIC, "the Draco library cannot write this: %.120s", made.error_msg());
    /* Flat things take next to nothing. Zeros behind the end, which no decoder looks at, keep the promise of decode. */
    const size_t least = std::max(g->n_points, g->n_triangles) / FS_DRACO_MOST_PER_BYTE + 1;
    const size_t room = std::max(buffer.size(), least);
    char *copy = static_cast<char *>(fs_allocate(ctx, room, 1));
    if (copy == nullptr) return FS_ERR_MEMORY;
    std::memcpy(copy, buffer.data(), buffer.size());
    for (int32_t i = 0; i < g->n_attributes; i++) id[i] = static_cast<int32_t>(mesh.attribute(number[i])->unique_id());
    *bytes = copy;
    *size = room;
    return FS_OK;
  });
}

fs_status fs_draco_decode(fs_context *ctx, const char *bytes, size_t size, fs_draco_mesh **mesh) {
  const fs_status status = fs_draco_check_head(ctx, bytes, size);
  if (status != FS_OK) return status;
  return guard(ctx, "read this", [&]() -> fs_status {
    draco::DecoderBuffer buffer;
    draco::Decoder decoder;
    buffer.Init(bytes, size);
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok())
      return fs_fail(ctx, FS_ERR_FORMAT, "the Draco library cannot read this: %.120s", decoded.status().error_msg());
    auto made = std::make_unique<fs_draco_mesh>();
    made->mesh = std::move(decoded).value();
    const char *damage = find_damage(*made->mesh);
    if (damage != nullptr) return fs_fail(ctx, FS_ERR_FORMAT, "the Draco file is damaged: %s", damage);
    *mesh = made.release();
    return FS_OK;
  });
}

void fs_draco_free(fs_draco_mesh *mesh) { delete mesh; }

int32_t fs_draco_n_points(const fs_draco_mesh *mesh) { return static_cast<int32_t>(mesh->mesh->num_points()); }

int32_t fs_draco_n_triangles(const fs_draco_mesh *mesh) { return static_cast<int32_t>(mesh->mesh->num_faces()); }

void fs_draco_corners(const fs_draco_mesh *mesh, int32_t *corner) {
  for (uint32_t t = 0; t < mesh->mesh->num_faces(); t++)
    for (int c = 0; c < 3; c++) *corner++ = static_cast<int32_t>(mesh->mesh->face(draco::FaceIndex(t))[c].value());
}

int32_t fs_draco_find(const fs_draco_mesh *mesh, fs_draco_kind kind, const char *name) {
  try {
    const int id = name != nullptr ? mesh->mesh->GetAttributeIdByMetadataEntry("name", name)
                                   : mesh->mesh->GetNamedAttributeId(kinds[kind]);
    if (id < 0 || mesh->mesh->attribute(id)->attribute_type() != kinds[kind]) return FS_NONE;
    return id;
  } catch (...) {
    return FS_NONE;
  }
}

int32_t fs_draco_find_id(const fs_draco_mesh *mesh, int32_t id) {
  const int found = mesh->mesh->GetAttributeIdByUniqueId(static_cast<uint32_t>(id));
  return found < 0 ? FS_NONE : found;
}

int32_t fs_draco_n_components(const fs_draco_mesh *mesh, int32_t attribute) {
  return mesh->mesh->attribute(attribute)->num_components();
}

int32_t fs_draco_n_values(const fs_draco_mesh *mesh, int32_t attribute) {
  return static_cast<int32_t>(mesh->mesh->attribute(attribute)->size());
}

void fs_draco_values_of_points(const fs_draco_mesh *mesh, int32_t attribute, int32_t *value) {
  const draco::PointAttribute *a = mesh->mesh->attribute(attribute);
  for (uint32_t p = 0; p < mesh->mesh->num_points(); p++)
    value[p] = static_cast<int32_t>(a->mapped_index(draco::PointIndex(p)).value());
}

void fs_draco_values(const fs_draco_mesh *mesh, int32_t attribute, float *x) {
  const draco::PointAttribute *a = mesh->mesh->attribute(attribute);
  const int n = a->num_components();
  for (uint32_t i = 0; i < a->size(); i++, x += n)
    if (!a->ConvertValue<float>(draco::AttributeValueIndex(i), static_cast<int8_t>(n), x))
      for (int c = 0; c < n; c++) x[c] = NAN; /* a double beyond single precision */
}

const char *fs_draco_entry_find(fs_draco_mesh *mesh, const char *key, size_t *size) {
  try {
    const draco::GeometryMetadata *metadata = mesh->mesh->GetMetadata();
    if (metadata == nullptr || !metadata->GetEntryBinary(key, &mesh->text)) return nullptr;
    *size = mesh->text.size();
    return reinterpret_cast<const char *>(mesh->text.data());
  } catch (...) {
    return nullptr;
  }
}

} // extern "C"
