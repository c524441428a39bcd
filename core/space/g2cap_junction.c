/* SPDX-License-Identifier: MIT */
/* Single role: the junction functions of a sector, from the compatibility of derivatives at its four corners.
   [Kiciak 2013; docs/g2caps.md section 5]

     symbol    code                 meaning
     r, q      jets[R], jets[Q]     curves along the sides v = 0, 1 (by u) and u = 0, 1 (by v), cross derivatives s, t
     b c f g   end[function]        junction functions: value, first and second derivative at both ends
     left      r_side               p_v, (p_v)', (p_v)'', p_vv, (p_vv)', (p_vv)'' at a corner, ' = d/du:
                                      p_v  = b1 r_u + c1 r_s
                                      p_vv = b2 r_u + c2 r_s + b1^2 r_uu + 2 b1 c1 r_us + c1^2 r_ss
     right     q_side               the same for p_u, p_uu with f, g, q, t and ' = d/dv

   Each equation says that one derivative of the patch is the same from both sides: V p_v, U p_u, UV p_uv, and so on.
   Solved in a fixed order, each gives two numbers; a function is completed by Hermite interpolation once enough of its
   end data are known.                                                                                               */
#include "space/g2cap_parts.h"
#include "math/bernstein.h"

#include <math.h>
#include <string.h>

enum { R, Q };                                          /* kinds of sides */
enum { V, U, UV, VV, UU, UVV, UUV, UUVV, N_EQUATIONS }; /* equations */
enum { B = FS_G2CAP_B, C = FS_G2CAP_C, F = FS_G2CAP_F, G = FS_G2CAP_G };
static const double TOLERANCE = 1e-11;

typedef double end_jet[3][5][2]; /* [n][m]: d^m along the side, d^n across */

typedef struct unfinished {
  end_jet jets[2][2][2]; /* [R or Q][side][end] */
  double end[16][2][3];  /* [function][end][derivative] */
} unfinished;

typedef struct step {
  enum { SOLVE, COMPLETE } kind;
  int32_t u, v, equation; /* corner */
  int32_t letter[2];      /* the two unknown functions, or the two to be completed */
  int32_t side, order;    /* COMPLETE only: side of the functions; both: order */
  int32_t derivative;     /* of the unknowns */
} step;

#define SOLVE_AT(u, v, equation, letter0, letter1, order, derivative) \
  { SOLVE, u, v, equation, {letter0, letter1}, 0, order, derivative }
#define COMPLETE_BOTH(letter0, letter1, side, order) \
  { COMPLETE, 0, 0, 0, {letter0, letter1}, side, order, 0 }

static const step STEPS[] = {
    SOLVE_AT(0, 0, V, B, C, 1, 0),   SOLVE_AT(0, 0, U, F, G, 1, 0),    SOLVE_AT(0, 0, VV, B, C, 2, 0),
    SOLVE_AT(0, 0, UU, F, G, 2, 0),  COMPLETE_BOTH(C, G, 0, 1),        SOLVE_AT(0, 0, UV, B, F, 1, 1),
    COMPLETE_BOTH(B, F, 0, 1),       SOLVE_AT(0, 1, UV, B, C, 1, 1),   SOLVE_AT(1, 0, UV, F, G, 1, 1),
    SOLVE_AT(0, 0, UVV, B, C, 2, 1), SOLVE_AT(0, 0, UUV, F, G, 2, 1),  SOLVE_AT(0, 1, UVV, B, C, 2, 1),
    SOLVE_AT(1, 0, UUV, F, G, 2, 1), COMPLETE_BOTH(C, G, 0, 2),        SOLVE_AT(0, 0, UUVV, B, F, 2, 2),
    COMPLETE_BOTH(B, F, 0, 2),       SOLVE_AT(0, 1, UUV, B, C, 1, 2),  SOLVE_AT(0, 1, UUVV, B, C, 2, 2),
    SOLVE_AT(1, 0, UVV, F, G, 1, 2), SOLVE_AT(1, 0, UUVV, F, G, 2, 2), COMPLETE_BOTH(C, G, 1, 1),
    SOLVE_AT(1, 1, UV, B, F, 1, 1),  COMPLETE_BOTH(B, F, 1, 1),        SOLVE_AT(1, 1, UVV, B, C, 2, 1),
    SOLVE_AT(1, 1, UUV, F, G, 2, 1), COMPLETE_BOTH(C, G, 1, 2),        SOLVE_AT(1, 1, UUVV, B, F, 2, 2),
    COMPLETE_BOTH(B, F, 1, 2),
};

/* out += factor f g: value and two derivatives of the product of a function f and a planar vector g. */
static void add_product(double factor, const double f[3], const double g[3][2], double out[3][2]) {
  for (int32_t x = 0; x < 2; x++) {
    out[0][x] += factor * f[0] * g[0][x];
    out[1][x] += factor * (f[1] * g[0][x] + f[0] * g[1][x]);
    out[2][x] += factor * (f[2] * g[0][x] + 2 * f[1] * g[1][x] + f[0] * g[2][x]);
  }
}

static void multiply(const double f[3], const double g[3], double out[3]) {
  out[0] = f[0] * g[0];
  out[1] = f[1] * g[0] + f[0] * g[1];
  out[2] = f[2] * g[0] + 2 * f[1] * g[1] + f[0] * g[2];
}

/* out[0 .. 2]: the first cross derivative of the patch along a side and its two derivatives at the end; out[3 .. 5]:
   the second cross derivative. */
static void derive_side(const unfinished *work, int32_t kind, int32_t side, int32_t at, double out[6][2]) {
  int32_t along = kind == R ? B : F, across = kind == R ? C : G;
  const double *b1 = work->end[fs_g2cap_function(along, side, 1)][at];
  const double *c1 = work->end[fs_g2cap_function(across, side, 1)][at];
  const double *b2 = work->end[fs_g2cap_function(along, side, 2)][at];
  const double *c2 = work->end[fs_g2cap_function(across, side, 2)][at];
  const end_jet *r = &work->jets[kind][side][at];
  double bb[3], bc[3], cc[3];
  multiply(b1, b1, bb);
  multiply(b1, c1, bc);
  multiply(c1, c1, cc);
  memset(out, 0, 12 * sizeof(double));
  add_product(1, b1, &(*r)[0][1], out); /* &r[n][m] runs over the derivatives of d^m_u d^n_s r along the side */
  add_product(1, c1, &(*r)[1][0], out);
  add_product(1, b2, &(*r)[0][1], out + 3);
  add_product(1, c2, &(*r)[1][0], out + 3);
  add_product(1, bb, &(*r)[0][2], out + 3);
  add_product(2, bc, &(*r)[1][1], out + 3);
  add_product(1, cc, &(*r)[2][0], out + 3);
}

/* left - right of an equation at the corner (u,v). */
static void subtract_sides(const unfinished *work, int32_t u, int32_t v, int32_t equation, double residual[2]) {
  const double(*r)[5][2] = work->jets[R][v][u], (*q)[5][2] = work->jets[Q][u][v];
  double r_side[6][2], q_side[6][2];
  const double *left[N_EQUATIONS] = {[V] = r_side[0], [U] = r[0][1],     [UV] = r_side[1],  [VV] = r_side[3],
                                     [UU] = r[0][2],  [UVV] = r_side[4], [UUV] = r_side[2], [UUVV] = r_side[5]};
  const double *right[N_EQUATIONS] = {[V] = q[0][1],    [U] = q_side[0],   [UV] = q_side[1],  [VV] = q[0][2],
                                      [UU] = q_side[3], [UVV] = q_side[2], [UUV] = q_side[4], [UUVV] = q_side[5]};
  derive_side(work, R, v, u, r_side);
  derive_side(work, Q, u, v, q_side);
  for (int32_t x = 0; x < 2; x++) residual[x] = left[equation][x] - right[equation][x];
}

/* Two unknowns enter their equation linearly, with the columns r_u, r_s, -q_v, -q_t for b, c, f, g. They are zero so
   far, so that columns . unknowns = -(left - right). */
static void solve_step(unfinished *work, const step *s) {
  double column[2][2], rhs[2], *unknown[2], determinant;
  for (int32_t i = 0; i < 2; i++) {
    int32_t kind = s->letter[i] == B || s->letter[i] == C ? R : Q, is_along = s->letter[i] == B || s->letter[i] == F;
    int32_t side = kind == R ? s->v : s->u, at = kind == R ? s->u : s->v;
    const double *direction = is_along ? work->jets[kind][side][at][0][1] : work->jets[kind][side][at][1][0];
    for (int32_t x = 0; x < 2; x++) column[i][x] = kind == R ? direction[x] : -direction[x];
    unknown[i] = &work->end[fs_g2cap_function(s->letter[i], side, s->order)][at][s->derivative];
  }
  subtract_sides(work, s->u, s->v, s->equation, rhs);
  determinant = column[0][0] * column[1][1] - column[0][1] * column[1][0];
  *unknown[0] = (rhs[1] * column[1][0] - rhs[0] * column[1][1]) / determinant;
  *unknown[1] = (rhs[0] * column[0][1] - rhs[1] * column[0][0]) / determinant;
}

/* b01 2, b02 3, b11 4, b12 5; c.. one less. */
static int32_t function_degree(int32_t letter, int32_t side, int32_t order) {
  return 2 * side + order + (letter == B || letter == F ? 1 : 0);
}

/* Interpolates the data known at 0 (up to three) and at 1, and reads off what was not known. */
static void complete_function(unfinished *work, fs_g2cap_junction *junction, int32_t letter, int32_t side,
                              int32_t order) {
  int32_t function = fs_g2cap_function(letter, side, order), degree = function_degree(letter, side, order);
  int32_t n0 = degree < 3 ? degree : 3;
  double derivative[6], (*end)[3] = work->end[function], *p = junction->polynomial[function];
  fs_bernstein_hermite(1, n0, end[0], degree + 1 - n0, end[1], p);
  junction->degree[function] = degree;
  memcpy(derivative, p, sizeof derivative);
  for (int32_t d = 0; d < 3; d++) {
    end[0][d] = derivative[0];
    end[1][d] = degree >= d ? derivative[degree - d] : 0;
    fs_bernstein_differentiate(degree >= d ? degree - d : 0, 1, derivative, derivative);
  }
}

/* Ends of a curve and its derivatives along the side. */
static void curve_ends(const fs_g2cap_curves *curves, end_jet at[2]) {
  for (int32_t n = 0; n < 3; n++) {
    double p[8 * 2];
    int32_t degree = curves->degree[n];
    memcpy(p, curves->value[n], (size_t)(2 * degree + 2) * sizeof *p);
    for (int32_t m = 0; m < 5; m++) {
      memcpy(at[0][n][m], p, 2 * sizeof *p);
      memcpy(at[1][n][m], p + 2 * degree, 2 * sizeof *p);
      fs_bernstein_differentiate(degree, 2, p, p);
      if (degree > 0) degree--;
    }
  }
}

/* The curves of the domain. At the centre all derivatives of order 2, 3, 4 vanish. At the ends on the boundary the
   third and fourth ones, left zero, meet the factor 0. */
static void set_jets(const fs_g2cap_domain *domain, unfinished *work, fs_g2cap_curves *curves) {
  for (int32_t spoke = 0; spoke < 2; spoke++) {
    double end[3][3][2];
    end_jet *jets = work->jets[spoke == 0 ? R : Q][0];
    memcpy(jets[0][0][1], domain->e[spoke], sizeof domain->e[spoke]);
    memcpy(jets[0][1][0], domain->n[spoke], sizeof domain->n[spoke]);
    fs_g2cap_ring_jet(spoke, 2, domain->grid[0], end[0][0]);
    for (int32_t n = 0; n < 3; n++) memcpy(jets[1][n], end[n], sizeof end[n]);
    fs_g2cap_ring_curves(spoke, 2, domain->grid[0], curves);
    curve_ends(curves, work->jets[spoke == 0 ? R : Q][1]);
  }
}

/* At the three corners on the boundary both patches of a side agree in parameters: b = f = 0, c = 1, g = 1, except that
   t of the spoke u = 0 points out of the sector: g01(1) = -1. */
static void set_boundary_corners(unfinished *work) {
  work->end[fs_g2cap_function(C, 0, 1)][1][0] = 1;
  work->end[fs_g2cap_function(G, 0, 1)][1][0] = -1;
  for (int32_t at = 0; at < 2; at++) {
    work->end[fs_g2cap_function(C, 1, 1)][at][0] = 1;
    work->end[fs_g2cap_function(G, 1, 1)][at][0] = 1;
  }
}

/* The largest residual of all equations; NaN if one is. */
static double worst_residual(const unfinished *work) {
  double worst = 0;
  for (int32_t corner = 0; corner < 4; corner++)
    for (int32_t equation = 0; equation < N_EQUATIONS; equation++) {
      double residual[2], size;
      subtract_sides(work, corner % 2, corner / 2, equation, residual);
      size = fmax(fabs(residual[0]), fabs(residual[1]));
      if (isnan(residual[0]) || isnan(residual[1])) return NAN;
      worst = fmax(worst, size);
    }
  return worst;
}

fs_status fs_g2cap_junction_solve(fs_context *ctx, const fs_g2cap_domain *domain, fs_g2cap_junction *junction) {
  fs_status status = FS_OK;
  unfinished *work = NULL;
  fs_g2cap_curves *curves = NULL;
  FS_ALLOC(ctx, work, 1);
  FS_ALLOC(ctx, curves, 1);
  set_jets(domain, work, curves);
  set_boundary_corners(work);
  for (size_t i = 0; i < sizeof STEPS / sizeof *STEPS; i++) {
    const step *s = &STEPS[i];
    if (s->kind == SOLVE)
      solve_step(work, s);
    else
      for (int32_t l = 0; l < 2; l++) complete_function(work, junction, s->letter[l], s->side, s->order);
  }
  junction->residual = worst_residual(work);
  if (!(junction->residual < TOLERANCE))
    status = fs_fail(ctx, FS_ERR_NUMERIC, "cap of valence %d: the sides of its sectors do not agree (residual %g)",
                     domain->valence, junction->residual);
done:
  fs_release(ctx, work);
  fs_release(ctx, curves);
  return status;
}
