/* SPDX-License-Identifier: MIT */
/* Spaces of piecewise polynomial surfaces over a mesh. Every element is a Bezier patch whose control points depend
   linearly on the unknowns (dofs): b = E c, Bezier extraction [Borden Scott Evans Hughes 2011]. E depends on the
   connectivity only, and congruent elements share one. */
#ifndef FAIRSURF_SPACE_H
#define FAIRSURF_SPACE_H

#include <fairsurf/mesh.h>
#include <fairsurf/refine.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Sides and corners of an element, parameters (u, v) in [0, 1]^2; the surface's outside is p_u x p_v:

        (0,1) --- side 2 --- (1,1)
          |                    |         Side s runs anticlockwise from corner s to corner s + 1:
        side 3              side 1       0: v = 0, u up    1: u = 1, v up    2: v = 1, u down    3: u = 0, v down
          |                    |
        (0,0) --- side 0 --- (1,0)                                                                                  */

typedef struct fs_extraction {
  int32_t degree_u, degree_v, n_dofs;
  int32_t
      n_offsets; /* the last n_offsets dofs are no control vertices: they add functions to a surface that is complete
                        without them. Rows of E sum to 1 over the others */
  double *E; /* [(degree_u + 1)(degree_v + 1)][n_dofs]; Bezier point (i, j), i along u, is row i + (degree_u + 1) j */
  double *chart; /* NULL: the unit square is the chart; else Bezier points [rows of E][2] of the element in the plane
                     domain of its cap, scaled so that the area per element is 1 on average */
  double *
      segment; /* NULL, or [4][4]: E is the product of this matrix with itself for u and for v, bicubic, dofs u fastest */
  int32_t valence;  /* of the cap; 4 for regular elements */
  bool is_borrowed; /* E and chart belong to the context */
} fs_extraction;

typedef struct fs_element {
  int32_t face;              /* control face it lies on */
  int32_t halfedge;          /* half-edge of that face along side 0, from corner (0, 0) */
  int32_t extraction;        /* shared by congruent elements */
  int32_t dof_start;         /* its dofs: dof[dof_start] .. dof[dof_start + extraction.n_dofs - 1] */
  int32_t neighbour[4];      /* element across each side, or FS_NONE */
  uint8_t neighbour_side[4]; /* the side of the neighbour that meets ours; it runs the other way */
} fs_element;

/* A cap and its own dofs. */
typedef struct fs_cap {
  int32_t vertex, valence;
  int32_t first_dof,
      n_dofs;       /* its inner coefficients: smooth ones first, then 16 per sector in the order of the sectors */
  int32_t halfedge; /* along the spoke from which sectors are counted, from the vertex; the coefficients depend on it */
} fs_cap;

typedef struct fs_space {
  int32_t n_vertices, n_dofs;                /* dofs 0 .. n_vertices - 1 are the control vertices */
  int32_t n_elements, n_extractions, n_caps; /* n_caps: special vertices that carry a cap */
  int32_t continuity;                        /* weakest contact between neighbouring elements: 2 for G2 */
  int64_t n_element_dofs;                    /* size of dof */
  fs_element *element;
  fs_extraction *extraction;
  fs_cap *cap; /* [n_caps] in the order of their vertices, and so are their dofs, which follow those of the vertices */
  int32_t *dof;
  fs_vec3
      *start; /* [n_dofs] positions of the control vertices; zero, or coefficients that were kept, for further dofs */
} fs_space;

/* Derivatives up to order 3, numbered the same everywhere. */
enum { FS_D, FS_DU, FS_DV, FS_DUU, FS_DUV, FS_DVV, FS_DUUU, FS_DUUV, FS_DUVV, FS_DVVV, FS_JET_SIZE };

/* A rule that covers faces with elements. Lines of a table, tried in order; a face belongs to the first that claims it. */
typedef struct fs_space_builder fs_space_builder;
typedef struct fs_patch_rule {
  const char *name, *summary;
  int32_t continuity;
  fs_status (*claim)(fs_context *ctx, const fs_mesh *mesh, int32_t rule, int32_t *owner); /* owner[face] = rule */
  fs_status (*build)(fs_context *ctx, const fs_mesh *mesh, int32_t rule, const int32_t *owner,
                     fs_space_builder *builder);
} fs_patch_rule;
FS_API extern const fs_patch_rule *const fs_patch_rules[]; /* ends with NULL: trim, bspline, g2cap */

/* Builds the space of a mesh: faces with a boundary vertex carry no element (trim); faces whose four corners have
   valence 4 carry a bicubic B-spline square; the k faces around an interior vertex of valence k = 3, 5 .. 24 carry a
   G2 cap of degree (9, 9) [Kiciak 2013]. FS_ERR_UNSUPPORTED names the face that no rule takes, or says that no face has
   a full net. The mesh is not kept. */
FS_API fs_status fs_space_create(fs_context *ctx, const fs_mesh *mesh, fs_space **space);

/* What moves the inside of a cap besides the control vertices. Inner coefficients are dofs of their own, offsets that
   start at zero: the linear cap [docs/g2caps.md, section 10]. They change the inside of the cap only, and its contact
   with the surroundings stays as it is. */
typedef enum fs_cap_inner {
  FS_CAPS_LINEAR, /* nothing: the least energy in the plane domain for the given vertices */
  FS_CAPS_SMOOTH, /* 16 .. 78 coefficients per cap, for functions of the whole cap */
  FS_CAPS_FULL    /* those, and 16 in each of its sectors */
} fs_cap_inner;

/* All zero: what fs_space_create does. */
typedef struct fs_space_options {
  fs_cap_inner caps;
  int32_t max_full_valence; /* caps of larger valence are smooth where full ones are asked for; 0: 8 */
  const fs_cap_notes *kept; /* coefficients to start with, or NULL: none. Their caps begin at their spokes, and are full
                               where they are full. What caps has no room for is left out */
} fs_space_options;

/* options may be NULL. Coefficients that do not fit the mesh are FS_ERR_FORMAT, as fs_space_check_caps says. */
FS_API fs_status fs_space_create_with(fs_context *ctx, const fs_mesh *mesh, const fs_space_options *options,
                                      fs_space **space);
FS_API void fs_space_free(fs_context *ctx, fs_space *space); /* NULL is allowed */

/* Whether the coefficients fit the mesh: FS_ERR_FORMAT names the first cap that does not, and says why. */
FS_API fs_status fs_space_check_caps(fs_context *ctx, const fs_mesh *mesh, const fs_cap_notes *notes);

/* The inner coefficients among the dofs c of a space over the mesh, to be kept with it. Caps whose coefficients are all
   zero are left out; NULL where all are. The caller frees. */
FS_API fs_status fs_space_keep_caps(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, const fs_vec3 *c,
                                    fs_cap_notes **notes);

/* fixed[n_dofs]: fixes the inner coefficients of caps whose vertices are all fixed, so that their surface stays. */
FS_API void fs_space_fix_caps(const fs_space *space, bool *fixed);

/* Checks the invariants: partition of unity of every extraction, element to element adjacency both ways, dofs in range,
   vertices and offsets in their places. */
FS_API fs_status fs_space_validate(fs_context *ctx, const fs_space *space);

/* What stands between a mesh and its space. */
typedef struct fs_space_obstacles {
  int32_t n_non_quads;       /* faces not of 4 vertices that a rule would have to cover or look at */
  int32_t n_close_specials;  /* special vertices that share a face with another one */
  int32_t n_rim_specials;    /* special vertices, or non-quads, that touch the boundary zone of trimmed faces */
  int32_t n_uncovered_faces; /* faces that no rule takes as the mesh stands; 0: the space can be made */
  int32_t n_elements, n_cap_elements, n_caps; /* what the space would consist of: elements, those of caps included */
  int32_t first_face;                         /* an uncovered face, or FS_NONE */
  int32_t bad_vertex;         /* interior vertex of valence 2 or above 24, which no refinement mends, or FS_NONE */
  bool special_near_boundary; /* a special vertex at edge distance 1 from the boundary, or a non-quad that touches it */
} fs_space_obstacles;
FS_API fs_status fs_space_examine(fs_context *ctx, const fs_mesh *mesh, fs_space_obstacles *obstacles);

/* Refines a mesh as often as its space needs, at most twice: by averagings (n = 3) when every special vertex is at edge
   distance 2 or more from the boundary, else by Catmull-Clark. Notes say which and why (ctx->note).
   steps[0 .. *n_steps - 1] are the refinements in order; the caller frees them. The mesh to use is that of the last one,
   or the given one if there is none. at_least: refine so often in any case (0 .. FS_MAX_REFINEMENTS - 2).
   FS_ERR_UNSUPPORTED where refinement cannot help: interior valence 2 or above 24, no face with a full net; and for
   meshes of mostly triangles with more than 5 000 faces unless at_least > 0. */
enum { FS_MAX_REFINEMENTS = 10 };
FS_API fs_status fs_space_prepare(fs_context *ctx, const fs_mesh *mesh, int32_t at_least,
                                  fs_refinement *steps[FS_MAX_REFINEMENTS], int32_t *n_steps);

/* fixed[n_dofs] = true for the control vertices that act on position, first or second derivatives at the rim: those at
   face distance 2 or less from the boundary (two steps over faces). Further dofs are free, except in caps whose
   vertices are all fixed. */
FS_API fs_status fs_space_rim(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, bool *fixed);

/* A mirror symmetry of a mesh and of the space over it. */
typedef struct fs_symmetry {
  fs_vec3 normal; /* unit length; the plane is normal . p = offset */
  double offset;
  double deviation; /* largest distance of a vertex of the mesh from where its mirror image says that it lies */
  int32_t n_vertices, n_elements;
  int32_t *vertex;  /* [n_vertices] the mirror image of each; of itself on the plane */
  int32_t *element; /* [n_elements] the mirror image of each */
  uint8_t *side;    /* [n_elements] the side of the image that is the image of side 0: the image of (u, v) is at
                       (1 - u, v), (1 - v, 1 - u), (u, 1 - v), (v, u) for 0, 1, 2, 3 */
} fs_symmetry;

/* The symmetry of a mesh about the plane normal . p = offset, or, where normal is NULL, about a plane that is searched:
   coordinate planes through the origin and through the centre of the vertices first, then all others. Vertices may
   deviate by 1e-6 of the diagonal of their bounding box. FS_ERR_ARGUMENT names the first vertex or face that has no
   mirror image, or says that there is no plane. A plane within 1e-9 of a coordinate plane is taken for it. */
FS_API fs_status fs_symmetry_create(fs_context *ctx, const fs_mesh *mesh, const fs_space *space, const fs_vec3 *normal,
                                    double offset, fs_symmetry **symmetry);
FS_API void fs_symmetry_free(fs_context *ctx, fs_symmetry *symmetry); /* NULL is allowed */

/* The mirror image of a point. Exact, and back again the same bits, for coordinate planes through the origin. */
FS_API fs_vec3 fs_symmetry_reflect(const fs_symmetry *symmetry, fs_vec3 p);

/* Where the image of the point (u, v) of an element lies in the image of that element. */
FS_API void fs_symmetry_parameters(const fs_symmetry *symmetry, int32_t element, double u, double v, double *image_u,
                                   double *image_v);

/* Makes the vertices of c[n_vertices] exactly symmetric: of two images of each other that of the larger number becomes the
   image of the other, and those that are images of themselves move onto the plane. */
FS_API void fs_symmetry_apply(const fs_symmetry *symmetry, fs_vec3 *c);

#ifdef __cplusplus
}
#endif
#endif
