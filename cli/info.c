/* SPDX-License-Identifier: MIT */
/* Single role: the command info: counts of a mesh, and what a space over it would consist of and cost. */
#include "cli.h"

#include <stdlib.h>

/* The space that fair and export would use. */
typedef struct plan {
  bool is_possible;
  char why[256]; /* why not, or the last note about refinement */
  int32_t n_refinements, n_vertices, n_faces, n_elements, n_caps, n_free;
  int64_t n_nodes; /* quadrature nodes of one evaluation */
} plan;

enum { NODES_SQUARE = 8 * 8, NODES_CAP = 12 * 12 };

static void keep_note(void *user, const char *text) {
  plan *p = user;
  snprintf(p->why, sizeof p->why, "%s", text);
}

static fs_status count_free(fs_context *ctx, const fs_mesh *mesh, plan *p) {
  fs_space shape = {.n_vertices = mesh->n_vertices, .n_dofs = mesh->n_vertices};
  bool *fixed = calloc((size_t)mesh->n_vertices, sizeof *fixed);
  fs_status status = FS_ERR_MEMORY;
  if (fixed != NULL) status = fs_space_rim(ctx, mesh, &shape, fixed);
  for (int32_t v = 0; v < mesh->n_vertices && status == FS_OK; v++) p->n_free += !fixed[v];
  free(fixed);
  return status;
}

static fs_status make_plan(fs_context *ctx, const fs_mesh *mesh, int32_t refine, plan *p) {
  fs_refinement *step[FS_MAX_REFINEMENTS];
  fs_space_obstacles o;
  fs_context quiet = *ctx;
  const fs_mesh *fine = mesh;
  fs_status status;
  *p = (plan){.is_possible = true};
  quiet.note = keep_note;
  quiet.user = p;
  status = fs_space_prepare(&quiet, mesh, refine, step, &p->n_refinements);
  if (status == FS_ERR_UNSUPPORTED) {
    p->is_possible = false;
    snprintf(p->why, sizeof p->why, "%s", quiet.message);
    return FS_OK;
  }
  if (status == FS_OK) {
    if (p->n_refinements > 0) fine = step[p->n_refinements - 1]->mesh;
    p->n_vertices = fine->n_vertices;
    p->n_faces = fine->n_faces;
    status = fs_space_examine(&quiet, fine, &o);
  }
  if (status == FS_OK) status = count_free(&quiet, fine, p);
  if (status == FS_OK) {
    p->n_elements = o.n_elements;
    p->n_caps = o.n_caps;
    p->n_nodes = (int64_t)NODES_SQUARE * (o.n_elements - o.n_cap_elements) + (int64_t)NODES_CAP * o.n_cap_elements;
  } else {
    snprintf(ctx->message, sizeof ctx->message, "%s", quiet.message);
  }
  for (int32_t i = 0; i < p->n_refinements; i++) fs_refinement_free(ctx, step[i]);
  return status;
}

static void print_counts(const char *title, const int32_t *count, bool json) {
  bool is_first = true;
  printf(json ? "  \"%s\": {" : "%s:", title);
  for (int i = 0; i < 26; i++)
    if (count[i] > 0) {
      if (json)
        printf("%s\"%s%d\": %d", is_first ? "" : ", ", i == 25 ? ">" : "", i == 25 ? 24 : i, count[i]);
      else
        printf(" %s%d:%d", i == 25 ? ">" : "", i == 25 ? 24 : i, count[i]);
      is_first = false;
    }
  printf(json ? "},\n" : "%s\n", is_first ? " -" : "");
}

static void print_text(const arguments *a, const fs_mesh_summary *s, const plan *p) {
  printf("%s: %d vertices, %d edges, %d faces\n", a->mesh, s->n_vertices, s->n_edges, s->n_faces);
  printf("components %d, boundary loops %d, genus %d\n", s->n_components, s->n_boundary_loops, s->genus);
  print_counts("faces by size", s->face_size, false);
  print_counts("interior vertices by valence", s->valence_interior, false);
  print_counts("boundary vertices by valence", s->valence_boundary, false);
  printf("box <%g, %g, %g> to <%g, %g, %g>\n", s->min.x, s->min.y, s->min.z, s->max.x, s->max.y, s->max.z);
  if (!p->is_possible) {
    printf("space: none: %s\n", p->why);
    return;
  }
  printf("space: after %d refinements %d vertices and %d faces, %d squares, %d caps, %d free vertices\n",
         p->n_refinements, p->n_vertices, p->n_faces, p->n_elements, p->n_caps, p->n_free);
  if (p->why[0] != '\0') printf("       %s\n", p->why);
  printf("cost: %lld quadrature nodes per evaluation\n", (long long)p->n_nodes);
}

static void print_json(const fs_mesh_summary *s, const plan *p, const fs_mesh_notes *notes) {
  printf("{\n  \"vertices\": %d,\n  \"edges\": %d,\n  \"faces\": %d,\n  \"components\": %d,\n", s->n_vertices,
         s->n_edges, s->n_faces, s->n_components);
  printf("  \"boundary_loops\": %d,\n  \"boundary_vertices\": %d,\n  \"genus\": %d,\n", s->n_boundary_loops,
         s->n_boundary_vertices, s->genus);
  print_counts("face_size", s->face_size, true);
  print_counts("valence_interior", s->valence_interior, true);
  print_counts("valence_boundary", s->valence_boundary, true);
  printf("  \"min\": [%.17g, %.17g, %.17g],\n  \"max\": [%.17g, %.17g, %.17g],\n", s->min.x, s->min.y, s->min.z,
         s->max.x, s->max.y, s->max.z);
  if (notes->caps != NULL)
    printf("  \"caps\": {\"caps\": %d, \"inner_coefficients\": %d},\n", notes->caps->n_caps,
           notes->caps->n_coefficients);
  printf("  \"space\": {\"possible\": %s, \"refinements\": %d, \"vertices\": %d, \"faces\": %d, \"squares\": %d, "
         "\"caps\": %d, "
         "\"free\": %d, \"quadrature_nodes\": %lld, \"note\": \"",
         p->is_possible ? "true" : "false", p->n_refinements, p->n_vertices, p->n_faces, p->n_elements, p->n_caps,
         p->n_free, (long long)p->n_nodes);
  for (const char *c = p->why; *c != '\0'; c++) {
    if (*c == '"' || *c == '\\') putchar('\\');
    putchar(*c);
  }
  printf("\"}\n}\n");
}

/* What the file says besides its mesh; nothing where it says nothing. */
static void print_notes(const fs_mesh *mesh, const fs_mesh_notes *notes) {
  int32_t n_fixed = 0;
  for (int32_t v = 0; v < mesh->n_vertices && notes->fixed != NULL; v++) n_fixed += notes->fixed[v] != 0;
  if (notes->made_with != NULL) printf("made with: %s\n", notes->made_with);
  if (notes->functional != NULL) printf("minimises: %s\n", notes->functional);
  if (notes->n_refinements > 0) printf("refined: %d times before\n", notes->n_refinements);
  if (notes->fixed != NULL) printf("marks: %d fixed vertices\n", n_fixed);
  if (notes->caps != NULL)
    printf("caps: %d with %d inner coefficients\n", notes->caps->n_caps, notes->caps->n_coefficients);
}

fs_status print_info(fs_context *ctx, const arguments *a, const fs_mesh *mesh, const fs_mesh_notes *notes) {
  fs_mesh_summary summary;
  plan p;
  fs_status status = fs_mesh_summarise(ctx, mesh, &summary);
  if (status == FS_OK && notes->caps != NULL) status = fs_space_check_caps(ctx, mesh, notes->caps);
  if (status == FS_OK) status = make_plan(ctx, mesh, a->refine, &p);
  if (status != FS_OK) return status;
  if (a->json) {
    print_json(&summary, &p, notes);
  } else {
    print_text(a, &summary, &p);
    print_notes(mesh, notes);
  }
  return FS_OK;
}
