/* SPDX-License-Identifier: MIT */
/* Single role: the choice of the next damping. A factorisation costs far more than anything else, so nu falls quickly where the
   model is good, to a Newton step in the end, and a memory of the largest nu that did not suffice keeps it from falling into the
   same hole at the next step.

   Relative to the diagonal of the Hessian nu ranges over fifteen powers of ten: on fine meshes that much lies between the rough
   and the smooth motions, and what is left to do at the end is smooth. A metric weighs all motions as the functional itself does;
   there a few powers of ten are all. */
#include "optimise/damping.h"

#include <math.h>

static void lower_of_metric(fs_nu *nu, double gain, bool has_failed, bool is_near) {
  nu->good = nu->now;
  if (is_near && gain > 0.5)
    nu->now = nu->now > 0.05 ? 0.1 * nu->now : 0;
  else if (fabs(gain - 1) < 0.01 && !has_failed)
    nu->now *= 0.01;
  else if (gain > 0.9)
    nu->now *= 0.1;
  else if (gain > 0.75)
    nu->now *= 0.3;
  else if (gain < 0.25)
    nu->now *= 4;
  if (!is_near) nu->now = fmax(nu->now, 3 * nu->failed);
  nu->failed *= 0.1;
  if (nu->now < 1e-6) nu->now = 0;
}

static void lower_of_diagonal(fs_nu *nu, double gain, bool has_failed) {
  if (fabs(gain - 1) < 0.002 && !has_failed) { /* the model is right: what failed was elsewhere */
    nu->now *= 1e-4;
    nu->failed *= 1e-3;
  } else if (gain > 0.9)
    nu->now *= 0.01;
  else if (gain > 0.75)
    nu->now *= 0.1;
  else if (gain < 0.25)
    nu->now *= 4;
  nu->now = fmax(nu->now, 3 * nu->failed);
  nu->failed = nu->failed < 1e-12 ? 0 : 0.1 * nu->failed;
  if (nu->now < nu->least) nu->now = nu->least;
  if (nu->now < 1e-15) nu->now = 0;
}

void fs_nu_lower(fs_nu *nu, double gain, bool has_failed, bool is_near) {
  if (nu->of_metric)
    lower_of_metric(nu, gain, has_failed, is_near);
  else
    lower_of_diagonal(nu, gain, has_failed);
  nu->growth = 2;
}

void fs_nu_raise_indefinite(fs_nu *nu) {
  nu->failed = fmax(nu->failed, nu->now);
  if (nu->of_metric)
    nu->now = fmax(fmax(4 * nu->now, 1e-3), 0.1 * nu->good);
  else if (nu->now == 0)
    nu->now = 1e-9;
  else
    nu->now *= nu->now < 1e-4 ? 10 : 4;
}

void fs_nu_raise_rejected(fs_nu *nu) {
  nu->failed = fmax(nu->failed, nu->now);
  nu->now = fmax(nu->now, nu->of_metric ? 1e-3 : 1e-8) * fmax(nu->growth, 4);
  nu->growth *= 2;
}
