/* SPDX-License-Identifier: MIT */
/* Control meshes: polygons around vertices, an oriented 2-manifold with or without boundary.
   The corners of the face list are the half-edges, so one structure is face list and half-edge mesh.
   Made by one function and never changed afterwards, but for the positions. */
#ifndef FAIRSURF_MESH_H
#define FAIRSURF_MESH_H

#include <fairsurf/base.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Half-edge h runs from origin[h] to the origin of the next half-edge of its face; the face lies at its left, seen from
   outside. Half-edges of one face follow each other in memory, so next and previous are index arithmetic. */
typedef struct fs_mesh {
  int32_t n_vertices, n_faces, n_halfedges;
  fs_vec3 *position;   /* [n_vertices] */
  int32_t *face_start; /* [n_faces + 1]: half-edges of face f are face_start[f] .. face_start[f + 1] - 1 */
  int32_t *origin;     /* [n_halfedges] vertex it leaves */
  int32_t *face;       /* [n_halfedges] face at its left */
  int32_t *twin;       /* [n_halfedges] the opposite half-edge, or FS_NONE at the boundary */
  int32_t *outgoing;   /* [n_vertices] a half-edge that leaves it; at the boundary the first one anticlockwise, whose
                          clockwise neighbour across the boundary is missing (its own twin is FS_NONE) */
} fs_mesh;

static inline int32_t fs_mesh_next(const fs_mesh *mesh, int32_t h) {
  int32_t f = mesh->face[h];
  return h + 1 == mesh->face_start[f + 1] ? mesh->face_start[f] : h + 1;
}
static inline int32_t fs_mesh_previous(const fs_mesh *mesh, int32_t h) {
  int32_t f = mesh->face[h];
  return h == mesh->face_start[f] ? mesh->face_start[f + 1] - 1 : h - 1;
}
static inline int32_t fs_mesh_target(const fs_mesh *mesh, int32_t h) { return mesh->origin[fs_mesh_next(mesh, h)]; }

/* The next half-edge anticlockwise that leaves the same vertex, or FS_NONE past the boundary. */
static inline int32_t fs_mesh_rotate(const fs_mesh *mesh, int32_t h) { return mesh->twin[fs_mesh_previous(mesh, h)]; }

static inline int32_t fs_mesh_face_size(const fs_mesh *mesh, int32_t f) {
  return mesh->face_start[f + 1] - mesh->face_start[f];
}

/* A vertex lies on the boundary if and only if the first of its half-edges has no twin. */
static inline bool fs_mesh_is_boundary(const fs_mesh *mesh, int32_t vertex) {
  return mesh->twin[mesh->outgoing[vertex]] == FS_NONE;
}

/* Number of edges at a vertex (one more than its faces at the boundary). */
FS_API int32_t fs_mesh_valence(const fs_mesh *mesh, int32_t vertex);

/* Makes a mesh from polygons: corner[face_start[f]] .. corner[face_start[f + 1] - 1] are the vertices of face f,
   anticlockwise seen from outside, 3 or more. All arrays are copied. Checks everything that makes an oriented manifold;
   FS_ERR_TOPOLOGY (or FS_ERR_ARGUMENT for indices and positions) names the first element that breaks it: index out of
   range, repeated vertex in a face, edge of more than two faces, two faces on one side of an edge, vertex with several
   fans of faces ("bow-tie"), vertex without faces, position that is not finite. Vertex and face numbers in messages
   count from 0. */
FS_API fs_status fs_mesh_create(fs_context *ctx, int32_t n_vertices, const fs_vec3 *position, int32_t n_faces,
                                const int32_t *face_start, const int32_t *corner, fs_mesh **mesh);
FS_API fs_status fs_mesh_copy(fs_context *ctx, const fs_mesh *mesh, fs_mesh **copy);
FS_API void fs_mesh_free(fs_context *ctx, fs_mesh *mesh); /* NULL is allowed */

/* Checks every invariant stated at fs_mesh; for tests and for meshes from elsewhere. */
FS_API fs_status fs_mesh_validate(fs_context *ctx, const fs_mesh *mesh);

/* Counts of a mesh. */
typedef struct fs_mesh_summary {
  int32_t n_vertices, n_edges, n_faces, n_components, n_boundary_loops, n_boundary_vertices;
  int32_t genus;                /* sum over the components */
  int32_t n_triangles, n_quads; /* faces of 3 and 4 vertices */
  int32_t valence_interior[26]; /* [0..24] vertices by number of edges; [25]: more than 24 */
  int32_t valence_boundary[26];
  int32_t face_size[26];
  fs_vec3 min, max; /* bounding box of the vertices */
} fs_mesh_summary;
FS_API fs_status fs_mesh_summarise(fs_context *ctx, const fs_mesh *mesh, fs_mesh_summary *summary);

/* The inner coefficients of a cap, as they are kept beside a mesh [docs/g2caps.md, section 10]. */
typedef struct fs_cap_note {
  int32_t vertex;   /* in the middle of the cap */
  int32_t spoke;    /* the vertex at the other end of the edge from which the sectors are counted */
  int32_t valence;  /* of vertex */
  int32_t first, n; /* its coefficients: those of the whole cap, or those and 16 in each sector */
} fs_cap_note;

enum { FS_CAP_BASIS = 1 }; /* number of the functions that coefficients belong to; another one is refused */

/* Those of a mesh: fs_space_create_with takes them, fs_space_keep_caps makes them. Caps that are not there have none. */
typedef struct fs_cap_notes {
  int32_t basis, n_caps, n_coefficients;
  fs_cap_note *cap;     /* [n_caps] */
  fs_vec3 *coefficient; /* [n_coefficients] */
} fs_cap_notes;
/* Arrays of zeros, for the caller to fill; basis is set. */
FS_API fs_status fs_cap_notes_create(fs_context *ctx, int32_t n_caps, int32_t n_coefficients, fs_cap_notes **notes);
FS_API void fs_cap_notes_free(fs_context *ctx, fs_cap_notes *notes); /* NULL is allowed */

/* What a file may say about its control mesh besides the polygons. All zero: nothing. */
typedef struct fs_mesh_notes {
  uint8_t *fixed;               /* [n_vertices] 1 where fairing kept the vertex; NULL: not said */
  char *made_with, *functional; /* as in fs_model; NULL: not said */
  int32_t n_refinements;
  fs_cap_notes *caps; /* as the file says, fit for the mesh or not; NULL: not said */
} fs_mesh_notes;
FS_API void fs_mesh_notes_clear(fs_context *ctx, fs_mesh_notes *notes);

/* A file format of control meshes. parse reads from memory and writes nothing but the mesh. */
typedef struct fs_reader {
  const char *name, *extension, *summary;
  fs_status (*parse)(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh);
  /* parse with what else the file says; NULL: the format says nothing else. */
  fs_status (*parse_notes)(fs_context *ctx, const char *bytes, size_t size, fs_mesh **mesh, fs_mesh_notes *notes);
} fs_reader;
FS_API extern const fs_reader *const fs_readers[]; /* ends with NULL */

/* Parses a mesh in the format whose extension is given ("obj"); FS_ERR_UNSUPPORTED lists the known ones.
   Memory stays within a small multiple of size whatever the bytes say, in compressed formats within that of 64 triangles
   per byte. Messages name the line, or the byte offset. */
FS_API fs_status fs_mesh_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh);

/* The same, and what the file says besides; notes is overwritten, for fs_mesh_notes_clear. */
FS_API fs_status fs_mesh_parse_notes(fs_context *ctx, const char *extension, const char *bytes, size_t size,
                                     fs_mesh **mesh, fs_mesh_notes *notes);

#ifdef __cplusplus
}
#endif
#endif
