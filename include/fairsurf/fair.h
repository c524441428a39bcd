/* SPDX-License-Identifier: MIT */
/* Fairing: choose the free dofs of a space so that an integral over its surface is least. */
#ifndef FAIRSURF_FAIR_H
#define FAIRSURF_FAIR_H

#include <fairsurf/space.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Points are handled in blocks of this many; the arrays of a density have them innermost. */
enum { FS_BLOCK = 8 };

/* An integrand: a function of the derivatives of the position at one point, and its own derivatives by them.
   n = 2, 5, 9 derivative vectors for order 1, 2, 3, numbered FS_DU, FS_DV, … minus 1:
     x[n][3][FS_BLOCK] -> f[FS_BLOCK], df[n][3][FS_BLOCK], ddf[n (n + 1) / 2][3][3][FS_BLOCK],
   ddf holds one 3x3 block per pair i <= j; pair (i, j) is number i n - i (i - 1) / 2 + j - i; block[a][b] is the second
   derivative by component a of vector i and component b of vector j. df and ddf may be NULL: that work is skipped. */
typedef struct fs_density {
  const char *name, *summary;
  int32_t order;     /* highest derivative used; the space needs continuity >= order - 1 */
  bool is_geometric; /* unchanged when the surface is reparametrised: fed derivatives by (u, v) and integrated over the
                        unit squares; else fed derivatives by the coordinates of the element's chart, integrated there */
  bool is_quadratic; /* the second derivatives are constant: one Newton step reaches the minimum */
  uint64_t
      zero_pairs; /* for order 3, bit (i, j): the second derivatives of that pair always vanish and need not be added */
  void (*evaluate)(const double *x, double *f, double *df, double *ddf);
} fs_density;
FS_API extern const fs_density
    fs_density_curvature_variation; /* |grad_M H|^2 sqrt(det G); S is its integral; length^-2 */
FS_API extern const fs_density
    fs_density_tangential; /* tangential part of |grad Laplace p|^2; Q is its integral; length^2 */
FS_API extern const fs_density fs_density_triharmonic; /* |grad Laplace p|^2; length^2 */
FS_API extern const fs_density fs_density_thin_plate;  /* |p_uu|^2 + 2 |p_uv|^2 + |p_vv|^2; length^2 */
FS_API extern const fs_density fs_density_willmore;    /* H^2 sqrt(det G); free of scale; 4 pi on a sphere */
FS_API extern const fs_density fs_density_area;        /* sqrt(det G); length^2 */

/* What a functional may depend on besides its parameters and integrals. */
typedef struct fs_scale {
  int32_t n_squares; /* elements of the space */
  double diameter;   /* largest distance between two points of which the place is given: fixed control vertices, held
                        points (0: fewer than two) */
} fs_scale;

/* A function of integrals. Lines of a table. */
enum { FS_MAX_TERMS = 8 };
typedef struct fs_functional {
  const char *name, *summary;
  const fs_param *params; /* ends with a NULL name; may be NULL */
  int32_t n_terms;        /* 1 .. FS_MAX_TERMS - 2 */
  const fs_density *term[FS_MAX_TERMS];
  /* Its value and first derivatives by the integrals: integral[n_terms] -> *value, derivative[n_terms]. */
  void (*combine)(const double *param, const fs_scale *scale, const double *integral, double *value,
                  double *derivative);
  bool is_linear; /* the derivatives are constants */
  bool
      is_scale_free; /* unchanged when the surface is scaled, so that nothing needs to be fixed; one term must be the area:
                         steps keep it to first order, and the result is scaled back to it */
  bool is_continued; /* the first parameter is lowered to its value in steps of ten, from 0.01 */
  const struct fs_functional *when_nothing_is_fixed; /* to use instead on closed surfaces; or NULL */
} fs_functional;
FS_API extern const fs_functional *const fs_functionals[];        /* ends with NULL; the first is the default */
FS_API const fs_functional *fs_functional_find(const char *name); /* NULL: unknown */

/* Why an iteration ended: the gradient, the step or the possible decrease became negligible; or a limit; or the caller. */
typedef enum fs_stop {
  FS_STOP_GRADIENT,
  FS_STOP_STEP,
  FS_STOP_DECREASE,
  FS_STOP_ITERATIONS,
  FS_STOP_CANCELLED,
  FS_STOP_TIME
} fs_stop;
FS_API const char *fs_stop_text(fs_stop stop); /* "gradient", "step", "decrease", "iterations", "cancelled", "time" */

/* One accepted step of the minimisation. */
typedef struct fs_step {
  int32_t number;  /* from 1; 0 is the start */
  int32_t stage;   /* from 0: in each the functional, or its quadrature, is another one; values fall within a stage */
  double value;    /* of the functional, after the step */
  double gradient; /* Euclidean norm of its gradient there */
  double damping;  /* relative to the diagonal of the Hessian; 0 for a Newton step */
  double length;   /* Euclidean norm of the step */
  double gain;     /* actual decrease / predicted decrease */
  int32_t n_factorisations; /* needed for this step */
  double seconds;           /* since the start */
  double c;                 /* weight of Q in the value */
} fs_step;

/* Values of the integrals, over all elements, fixed ones included. */
typedef struct fs_energy {
  double F;                                                   /* the functional */
  double integral[FS_MAX_TERMS], integral_caps[FS_MAX_TERMS]; /* of each term, unweighted; the part on caps */
  double weight[FS_MAX_TERMS];                                /* derivatives of the functional by the integrals */
  double S, S_caps, Q; /* curvature variation, its part on caps, tangential part; whatever the functional is */
  double gradient; /* Euclidean norm of the gradient of F by the unknowns: the free dofs, or what constraints leave */
} fs_energy;

/* How far these numbers can be trusted, and how even the parametrisation is. */
typedef struct fs_quality {
  int32_t n_nodes_square, n_nodes_cap; /* Gauss nodes per direction of this measurement */
  double S, S_caps;                    /* the curvature variation by them */
  double area;
  double
      least_density; /* least |p_u x p_v| by its mean over the surface: near 0 where the surface folds over or pinches */
  int32_t face;      /* where that is */
} fs_quality;

/* ---- constraints: what the surface must keep besides its fixed dofs [docs/constraints.md] ---- */

/* A point of the surface that is held: its place, its tangent plane, or both. */
typedef struct fs_hold {
  const char *name; /* for messages: "points.txt, line 3"; NULL: its number */
  int32_t element;
  double u, v; /* in [0, 1] */
  bool has_position, has_normal;
  fs_vec3 position; /* where it must lie */
  fs_vec3 normal;   /* of its tangent plane; any length but 0 */
} fs_hold;

/* The sum of weight * dof over its terms is a given point; or has a given component along a direction. */
typedef struct fs_equation {
  const char *name; /* as in fs_hold */
  int32_t n_terms;
  const int32_t *dof;   /* [n_terms] */
  const double *weight; /* [n_terms] */
  fs_vec3 direction;    /* zero: the whole point; else any length, and the sum's scalar product with it is value.x */
  fs_vec3 value;
} fs_equation;

/* What a surface must stay near. distance is called from several threads; an upper bound of the distance will do. */
typedef struct fs_target {
  double (*distance)(const void *self, fs_vec3 p, fs_vec3 *nearest); /* nearest: the point at that distance */
  const void *self;
} fs_target;

typedef enum fs_keep { FS_KEEP_NOTHING, FS_KEEP_AREA, FS_KEEP_VOLUME } fs_keep;

/* All zero: none. */
typedef struct fs_constraints {
  int32_t n_holds, n_equations;
  const fs_hold *hold;
  const fs_equation *equation;
  const fs_symmetry *symmetry; /* the dofs stay mirror images of each other; NULL: no symmetry */
  fs_keep keep;                /* of a surface of which no places are given: its area, as without constraints, or
                                  its volume, 1/3 of the integral of p . (p_u x p_v) */
  double tolerance;            /* largest distance of a point of the surface from the target; 0: any */
  const fs_target *target;     /* needed with a tolerance */
} fs_constraints;

typedef struct fs_fair_options {
  const fs_functional *functional; /* NULL: the first of the table */
  const double *param;             /* NULL: initial values of its params */
  const fs_mesh *mesh; /* the mesh of the space: large ones that are refinements are minimised from coarse to
                                          fine displacements; NULL: at once */
  const bool *fixed;   /* [n_dofs], at least the rim where there is one; NULL: nothing is fixed */
  const fs_constraints *constraints;   /* NULL: none */
  int32_t n_nodes_square, n_nodes_cap; /* Gauss nodes per direction; 0: 8 on squares, 12 in caps; at most 32 */
  double max_seconds;                  /* 0: no limit */
  int32_t max_iterations;    /* 0: 300, or 400 with a tolerance; negative: none, only the energies are reported */
  double gradient_tolerance; /* relative to the start; 0: 1e-8 */
  double decrease_tolerance; /* above 0: stop where a step promises less than this part of the functional; then the
                                gradient is not asked for, nor whether the end is a saddle */
  bool polish;               /* lower a continued parameter to a hundredth of its value, as long as a step brings 1e-4:
                                fairer by a little, squares less even, and the minimum need not be unique */
  bool
      along_normals; /* control vertices move along the normals of the surface only, which keeps the parametrisation: a third
                         of the unknowns. The result depends on the start. Inner coefficients of caps stay. Not with
                         constraints other than keep */
  bool start_triharmonic; /* begin at the minimum of the triharmonic functional (a linear problem) */
  bool (*monitor)(void *user, const fs_step *step); /* called after every accepted step; false cancels */
  bool (*iterate)(void *user, const fs_step *step, const fs_vec3 *c); /* likewise, with the dofs, lent for the call */
  void *monitor_user;                                                 /* for both */
} fs_fair_options;

/* Where the time of a fairing went: processor seconds, those of all threads of the process together. */
typedef struct fs_costs {
  int32_t n_gradients, n_hessians;                /* evaluations, each with what comes before it in the other */
  double points_of_gradients, points_of_hessians; /* quadrature points of all of them together */
  double gradients, hessians;
  double analysis, factorisations;   /* orders of elimination, on all levels; numeric factorisations */
  double factor_flops, factor_bytes; /* of one factorisation of the largest matrix, and of its factor */
} fs_costs;

enum { FS_MAX_TRACE = 256 };
typedef struct fs_fair_report {
  const fs_functional *functional; /* the one used, which may be when_nothing_is_fixed of the one asked for */
  fs_stop stop;
  int32_t n_free, n_squares, n_caps; /* free dofs (a dof is a point), elements, special vertices */
  int32_t n_free_inner;              /* those of n_free that are inner coefficients of caps */
  int32_t n_unknowns;                /* points that remain to be chosen when constraints are met; n_free without any */
  int32_t n_coarse;                  /* meshes of which this one is a refinement, whose displacements came first */
  int32_t n_steps, n_hessians, n_factorisations;
  int32_t n_saddles; /* stationary points that were no minima, and were left */
  fs_costs costs;    /* of the minimisation */
  double distance;   /* with a tolerance: the largest distance from the target that was measured at the end */
  double kept; /* where nothing is fixed: the area or the volume at the end, divided by that at the start, minus 1 */
  double c;    /* weight of Q in F; 0 where the functional has no such term */
  fs_energy start, end;
  fs_quality quality; /* of the result, by 12 nodes on squares and 24 in caps */
  int32_t n_trace;
  fs_step trace[FS_MAX_TRACE]; /* the start and the first accepted steps */
} fs_fair_report;

/* Moves the free dofs of c[n_dofs] (in: a start, for example space->start; out: the result) to a minimum of the
   functional: Levenberg-Marquardt with gain ratio, Newton steps at the end, exact Hessians [Kiciak 2013; docs/]. Noise is
   taken off a rough start before (docs/curvature-variation.md).
   Cancelling by monitor or by ctx->progress keeps the best iterate: FS_OK and stop = FS_STOP_CANCELLED.
   Constraints are met by the result however it ends; where the start does not meet them it is moved first. One that contradicts
   others is FS_ERR_ARGUMENT with its name; one that follows from others is left out, with a note. A tolerance that the start
   exceeds, and constraints that leave the size free, are FS_ERR_UNSUPPORTED.
   No free dof: FS_OK, nothing moves. A functional of order above continuity + 1 is FS_ERR_UNSUPPORTED.
   A surface that is not regular at a quadrature node at the start (p_u x p_v = 0) is FS_ERR_NUMERIC, with the face. */
FS_API fs_status fs_fair(fs_context *ctx, const fs_space *space, const fs_fair_options *options, fs_vec3 *c,
                         fs_fair_report *report);

/* The energies of the surface with dofs c; F and gradient by options as fs_fair has them. */
FS_API fs_status fs_fair_energy(fs_context *ctx, const fs_space *space, const fs_fair_options *options,
                                const fs_vec3 *c, fs_energy *energy);

/* Measures the surface with dofs c by a quadrature of its own; 0 nodes: 12 on squares, 24 in caps; at most 32. */
FS_API fs_status fs_fair_quality(fs_context *ctx, const fs_space *space, const fs_vec3 *c, int32_t n_nodes_square,
                                 int32_t n_nodes_cap, fs_quality *quality);

/* Name of the BLAS library that the solver runs on, for example a path; and whether it is the slow reference one. */
FS_API const char *fs_blas_name(bool *is_reference);

/* Number of threads of that BLAS, where it can be told (OpenBLAS), and whether CHOLMOD may start threads of its own; settings
   of the process and the calling thread. One thread is best below about 5 000 unknown points, and makes results the same on
   every run. */
FS_API void fs_blas_set_threads(int32_t n_threads);

#ifdef __cplusplus
}
#endif
#endif
