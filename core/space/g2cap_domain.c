/* SPDX-License-Identifier: MIT */
/* Single role: the plane net of a cap, and the jets and curves that any net imposes along the sides of a sector.
   [Kiciak 2013; docs/g2caps.md sections 2 to 4]

   The net is V_i = w^i V_0, w = exp(2 pi i/k), an eigenvector of refinement (Catmull-Clark away from the centre) for

     lambda = (5 + c + sqrt((c + 1)(c + 9))) / 16,  c = cos(2 pi/k)

   Around the hole lies the uniform bicubic B-spline X(alpha,beta) = sum V(a,b) N(alpha-a) N(beta-b); at a knot j the
   coefficients j-1, j, j+1 have the weights KNOT, and the piece [j,j+1] has the Bezier points SEGMENT.             */
#include "space/g2cap_parts.h"
#include "math/bernstein.h"

#include <complex.h>
#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

static const double KNOT[3][3] = {{1.0 / 6, 2.0 / 3, 1.0 / 6}, {-0.5, 0, 0.5}, {1, -2, 1}};
static const double SEGMENT[4][4] = {
    {1.0 / 6, 4.0 / 6, 1.0 / 6, 0}, {0, 4.0 / 6, 2.0 / 6, 0}, {0, 2.0 / 6, 4.0 / 6, 0}, {0, 1.0 / 6, 4.0 / 6, 1.0 / 6}};

int32_t fs_g2cap_vertex(int32_t valence, int32_t sector, int32_t a, int32_t b) {
  if (a == 0 && b == 0) return 0;
  if (b < 0) return fs_g2cap_vertex(valence, sector - 1, -b, a);
  if (a <= 0) return fs_g2cap_vertex(valence, sector + 1, b, -a);
  sector = (sector % valence + valence) % valence;
  return 1 + 6 * sector + 2 * b + a - 1;
}

/* V(1,0) = 1, V(2,0), V(1,1), V(2,1), V(1,2), V(2,2) of sector 0, not scaled; returns V(3,0). */
static double solve_eigenvector(double lambda, double c, double complex w, double complex V[6]) {
  double mu = lambda - 1.0 / 16, A = 1, g;
  double complex F = A * (1 + w) / (4 * lambda - 1), p, q, r;
  g = (9 * A / 16 + 3 * creal(F) / 16 + A * c / 32 + (3 * (A + creal(F)) / 8 + A * c / 16) / (32 * mu)) /
      (lambda - 3.0 / 32 - 1 / (512 * mu));
  p = (3 * (A + F) / 8 + (A * w + g) / 16) / mu;
  q = w * conj(p);
  r = (9 * F / 16 + 3 * (A + A * w + p + q) / 32 + g * (1 + w) / 64) / (lambda - 1.0 / 64);
  V[0] = A, V[1] = g, V[2] = F, V[3] = p, V[4] = q, V[5] = r;
  return (3 * (A + g) / 8 + (creal(F) + creal(p)) / 8) / lambda;
}

void fs_g2cap_domain_net(int32_t valence, double *eigenvalue, double *net) {
  double angle = 2 * pi / valence, c = cos(angle), lambda = (5 + c + sqrt((c + 1) * (c + 9))) / 16;
  double complex V[6];
  double scale = 3 / solve_eigenvector(lambda, c, c + I * sin(angle), V);
  *eigenvalue = lambda;
  net[0] = net[1] = 0;
  for (int32_t i = 0; i < valence; i++)
    for (int32_t j = 0; j < 6; j++) {
      double complex z = scale * V[j] * (cos(angle * i) + I * sin(angle * i));
      net[2 * (1 + 6 * i + j)] = creal(z);
      net[2 * (1 + 6 * i + j) + 1] = cimag(z);
    }
}

/* out [width] += weight grid(a,b) */
static void add_vertex(int32_t width, const double *grid, int32_t a, int32_t b, double weight, double *out) {
  const double *vertex = grid + fs_g2cap_grid(a, b) * width;
  for (int32_t w = 0; w < width; w++) out[w] += weight * vertex[w];
}

void fs_g2cap_ring_curves(int32_t along, int32_t width, const double *grid, fs_g2cap_curves *curves) {
  for (int32_t n = 0; n < 3; n++) {
    curves->degree[n] = 3;
    memset(curves->value[n], 0, (size_t)(4 * width) * sizeof(double));
    for (int32_t i = 0; i < 4; i++)
      for (int32_t across = 0; across <= 2; across++)
        for (int32_t t = -1; t <= 2; t++)
          add_vertex(width, grid, along == 1 ? across : t, along == 1 ? t : across, KNOT[n][across] * SEGMENT[i][t + 1],
                     curves->value[n] + i * width);
  }
}

void fs_g2cap_ring_jet(int32_t spoke, int32_t width, const double *grid, double *jet) {
  memset(jet, 0, (size_t)(9 * width) * sizeof *jet);
  for (int32_t n = 0; n < 3; n++)
    for (int32_t m = 0; m < 3; m++)
      for (int32_t a = 0; a <= 2; a++)
        for (int32_t b = -1; b <= 1; b++) /* V_1(a,b) = V_0(-b,a) */
          add_vertex(width, grid, spoke == 0 ? a : -b, spoke == 0 ? b : a, KNOT[m][a] * KNOT[n][b + 1],
                     jet + (3 * n + m) * width);
}

void fs_g2cap_spoke_curves(int32_t width, const double *centre, const double *end, fs_g2cap_curves *curves) {
  for (int32_t n = 0; n < 3; n++) {
    curves->degree[n] = 7 - n;
    fs_bernstein_hermite(width, 5 - n, centre + 5 * n * width, 3, end + 3 * n * width, curves->value[n]);
  }
}

void fs_g2cap_domain_set(int32_t valence, double eigenvalue, const double *net, fs_g2cap_domain *domain) {
  double jet[3][3][2];
  domain->valence = valence;
  domain->eigenvalue = eigenvalue;
  for (int32_t b = -1; b <= 2; b++)
    for (int32_t a = -1; a <= 2; a++) {
      if (a < 0 && b < 0) continue;
      memcpy(domain->grid[fs_g2cap_grid(a, b)], net + 2 * fs_g2cap_vertex(valence, 0, a, b), 2 * sizeof(double));
    }
  for (int32_t spoke = 0; spoke < 2; spoke++) {
    fs_g2cap_ring_jet(spoke, 2, domain->grid[0], jet[0][0]);
    memcpy(domain->e[spoke], jet[0][0], sizeof jet[0][0]);
    memcpy(domain->n[spoke], jet[1][0], sizeof jet[1][0]);
  }
}
