/* SPDX-License-Identifier: MIT */
/* fairsurf on the command line: file -> mesh -> refine -> space -> fair -> surface -> files, top to bottom. */
#include "cli.h"

#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* ---- Ctrl-C: the first asks to stop, the second ends at once ---- */

static volatile sig_atomic_t is_interrupted;

static void interrupt(int signal) {
  (void)signal;
  if (is_interrupted) _exit(EXIT_CANCELLED);
  is_interrupted = 1;
}

static bool go_on(void *user, const char *stage, double fraction) {
  (void)user, (void)stage, (void)fraction;
  return !is_interrupted;
}

/* What looks on while fairing goes on. */
typedef struct onlooker {
  bool is_shown;
  fs_context *ctx;
  iterates iterates;
} onlooker;

static bool show_step(void *user, const fs_step *s, const fs_vec3 *c) {
  onlooker *o = user;
  if (o->is_shown)
    fprintf(stderr, "\r%3d  F %-18.12g gradient %-10.3g damping %-9.2g %6.1f s ", s->number, s->value, s->gradient,
            s->damping, s->seconds);
  return write_iterate(o->ctx, &o->iterates, s, c) && !is_interrupted;
}

static void print_note(void *user, const char *text) {
  (void)user;
  fprintf(stderr, "fairsurf: %s\n", text);
}

int exit_code(fs_status status) {
  switch (status) {
  case FS_OK:
    return 0;
  case FS_ERR_IO:
    return EXIT_FILE;
  case FS_ERR_NUMERIC:
  case FS_ERR_MEMORY:
    return EXIT_NUMERIC;
  case FS_ERR_CANCELLED:
    return EXIT_CANCELLED;
  default:
    return EXIT_REFUSED;
  }
}

/* ---- the path ---- */

typedef struct job {
  fs_context *ctx;
  const arguments *arguments;
  fs_mesh *mesh, *control; /* as read; with the final positions */
  fs_mesh_notes notes;     /* what the file says besides */
  fs_refinement *step[FS_MAX_REFINEMENTS];
  int32_t n_steps;
  const fs_mesh *fine; /* of the last step, or the mesh as read */
  fs_space *space;
  fs_surface *surface, *start; /* start: for --before-after only */
  bool *fixed;
  fs_vec3 *c;
  constraint_set constraints;
  fs_cap_notes *caps; /* what c holds behind the vertices, or NULL */
  fs_fair_report report;
  timings seconds;
  bool passes; /* check: what is required is there */
  char made_with[200];
  const char *functional; /* that the control net minimises: part of made_with or of the notes; or NULL */
} job;

#define TRY(call)                         \
  do {                                    \
    fs_status status_ = (call);           \
    if (status_ != FS_OK) return status_; \
  } while (0)

static fs_status no_memory(fs_context *ctx) {
  snprintf(ctx->message, sizeof ctx->message, "out of memory");
  return FS_ERR_MEMORY;
}

static fs_status make_space(job *j) {
  const arguments *a = j->arguments;
  if (a->no_refine) {
    fs_space_obstacles o;
    TRY(fs_space_examine(j->ctx, j->mesh, &o));
    if (o.n_uncovered_faces > 0) {
      snprintf(j->ctx->message, sizeof j->ctx->message,
               "%d faces take no patch without refinement (the first is face %d): %d faces are no quadrilaterals, %d "
               "special "
               "vertices share a face with another one, %d are too close to the boundary",
               o.n_uncovered_faces, o.first_face, o.n_non_quads, o.n_close_specials, o.n_rim_specials);
      return FS_ERR_UNSUPPORTED;
    }
  }
  TRY(fs_space_prepare(j->ctx, j->mesh, a->refine, j->step, &j->n_steps));
  j->fine = j->n_steps > 0 ? j->step[j->n_steps - 1]->mesh : j->mesh;
  TRY(create_space(j->ctx, a, j->fine, j->notes.caps, j->n_steps > 0, &j->space));
  j->c = malloc((size_t)j->space->n_dofs * sizeof *j->c);
  j->fixed = calloc((size_t)j->space->n_dofs, sizeof *j->fixed);
  if (j->c == NULL || j->fixed == NULL) return no_memory(j->ctx);
  memcpy(j->c, j->space->start, (size_t)j->space->n_dofs * sizeof *j->c);
  return FS_OK;
}

/* mark[n_vertices] of the mesh as read: those of its own file, and those of --fixed. */
static fs_status collect_marks(job *j, bool *mark) {
  if (j->arguments->fixed != NULL)
    TRY(read_marks(j->ctx, j->arguments->fixed, j->mesh->n_vertices, mark));
  else
    memset(mark, 0, (size_t)j->mesh->n_vertices);
  for (int32_t v = 0; v < j->mesh->n_vertices && j->notes.fixed != NULL; v++) mark[v] |= j->notes.fixed[v] != 0;
  return FS_OK;
}

/* The marks of the input mesh, carried through the refinements, are added to the fixed vertices. */
static fs_status add_marks(job *j) {
  bool *mark, *fine;
  fs_status status;
  if (j->arguments->fixed == NULL && j->notes.fixed == NULL) return FS_OK;
  mark = malloc((size_t)j->mesh->n_vertices);
  if (mark == NULL) return no_memory(j->ctx);
  status = collect_marks(j, mark);
  for (int32_t s = 0; s < j->n_steps && status == FS_OK; s++) {
    fine = malloc((size_t)j->step[s]->mesh->n_vertices);
    if (fine == NULL) {
      status = no_memory(j->ctx);
      break;
    }
    fs_refinement_marks(j->step[s], mark, fine);
    free(mark);
    mark = fine;
  }
  for (int32_t v = 0; v < j->fine->n_vertices && status == FS_OK; v++) j->fixed[v] |= mark[v];
  free(mark);
  return status;
}

enum { MANY_VERTICES = 5000 }; /* below, threads of the BLAS wait for each other longer than they work */

static fs_status make_fair(job *j) {
  const arguments *a = j->arguments;
  onlooker o = {isatty(STDERR_FILENO) && !a->quiet,
                j->ctx,
                {.folder = a->every, .mesh = j->fine, .space = j->space, .film = a->film, .film_param = a->film_param}};
  fs_fair_options options = {.functional = a->functional,
                             .param = a->functional_param,
                             .mesh = j->fine,
                             .fixed = j->fixed,
                             .n_nodes_square = a->nodes,
                             .n_nodes_cap = a->nodes,
                             .constraints = &j->constraints.constraints,
                             .max_iterations = a->max_iterations > 0 ? a->max_iterations : -1 - a->max_iterations,
                             .max_seconds = a->max_seconds,
                             .decrease_tolerance = a->stop_decrease,
                             .polish = a->polish,
                             .along_normals = a->along_normals,
                             .start_triharmonic = a->start_triharmonic,
                             .iterate = show_step,
                             .monitor_user = &o};
  fs_status status;
  TRY(fs_space_rim(j->ctx, j->fine, j->space, j->fixed));
  TRY(add_marks(j));
  TRY(make_constraints(j->ctx, &a->constraints, j->fine, j->space, j->c, j->n_steps > 0, j->fixed, &j->constraints));
  fs_space_fix_caps(j->space, j->fixed);
  TRY(begin_iterates(j->ctx, &o.iterates));
  if (j->fine->n_vertices >= MANY_VERTICES) fs_blas_set_threads(a->blas_threads);
  status = fs_fair(j->ctx, j->space, &options, j->c, &j->report);
  if (o.is_shown) fprintf(stderr, "\n");
  if (status == FS_OK) TRY(o.iterates.status);
  if (status == FS_OK && a->film != NULL) TRY(end_film(j->ctx, &o.iterates));
  if (status == FS_OK && j->report.n_free == 0) print_note(NULL, "no vertex is free: the surface stays as it is");
  if (j->report.stop == FS_STOP_CANCELLED) print_note(NULL, "cancelled: the best surface so far is written");
  return status;
}

static fs_status write_outputs(job *j) {
  const arguments *a = j->arguments;
  TRY(fs_mesh_copy(j->ctx, j->fine, &j->control));
  memcpy(j->control->position, j->c, (size_t)j->control->n_vertices * sizeof *j->c);
  TRY(fs_space_keep_caps(j->ctx, j->control, j->space, j->c, &j->caps));
  TRY(fs_surface_create(j->ctx, j->space, j->c, &j->surface));
  if (j->constraints.symmetry != NULL) TRY(fs_surface_mirror(j->ctx, j->constraints.symmetry, j->surface));
  if (a->command == COMMAND_FAIR && a->before_after != NULL) {
    TRY(fs_surface_create(j->ctx, j->space, j->space->start, &j->start));
    TRY(write_before_after(j->ctx, a, j->start, j->surface));
  }
  for (int32_t i = 0; i < a->n_outputs; i++) {
    const output_request *o = &a->output[i];
    bool is_surface = o->is_surface || o->exporter->what == FS_EXPORT_SURFACE;
    fs_model model = {.name = a->name,
                      .control = j->control,
                      .surface = is_surface ? j->surface : NULL,
                      .colour = o->colour,
                      .fixed = (const uint8_t *)j->fixed,
                      .caps = j->caps,
                      .made_with = j->made_with,
                      .functional = j->functional,
                      .n_refinements = j->notes.n_refinements + j->n_steps};
    TRY(fs_export_file(j->ctx, &model, o->param, o->path));
  }
  return FS_OK;
}

static fs_status run_refine(job *j) {
  const arguments *a = j->arguments;
  int32_t n = a->refine > 0 ? a->refine : 1;
  const fs_mesh *mesh = j->mesh;
  note_lost_caps(j->ctx, j->notes.caps);
  for (; j->n_steps < n; j->n_steps++) {
    TRY(fs_mesh_refine(j->ctx, mesh, a->refiner, a->refiner_param, &j->step[j->n_steps]));
    mesh = j->step[j->n_steps]->mesh;
  }
  for (int32_t i = 0; i < a->n_outputs; i++) {
    fs_model model = {.name = a->name,
                      .control = mesh,
                      .made_with = j->made_with,
                      .n_refinements = j->notes.n_refinements + j->n_steps};
    if (a->output[i].exporter->what == FS_EXPORT_SURFACE || a->output[i].is_surface) {
      snprintf(j->ctx->message, sizeof j->ctx->message, "%s: refine writes control nets (.obj, .off, .ply, .drc)",
               a->output[i].path);
      return FS_ERR_UNSUPPORTED;
    }
    TRY(fs_export_file(j->ctx, &model, a->output[i].param, a->output[i].path));
  }
  return FS_OK;
}

static void describe(job *j) {
  const arguments *a = j->arguments;
  int used = snprintf(j->made_with, sizeof j->made_with, "fairsurf %s", fs_version());
  j->functional = j->notes.functional;
  if (a->command == COMMAND_FAIR) {
    used += snprintf(j->made_with + used, sizeof j->made_with - (size_t)used, ", ");
    j->functional = j->made_with + used;
    used += snprintf(j->made_with + used, sizeof j->made_with - (size_t)used, "%s", a->functional->name);
    for (int i = 0;
         a->functional->params != NULL && a->functional->params[i].name != NULL && used < (int)sizeof j->made_with; i++)
      used += snprintf(j->made_with + used, sizeof j->made_with - (size_t)used, " %s=%g", a->functional->params[i].name,
                       a->functional_param[i]);
    if (a->polish && used < (int)sizeof j->made_with)
      snprintf(j->made_with + used, sizeof j->made_with - (size_t)used, " polished");
  }
}

static fs_status run(job *j) {
  const arguments *a = j->arguments;
  double start = now(), then = start, t;
  if (a->command == COMMAND_PATCH) return run_patch(j->ctx, a);
  if (a->command == COMMAND_PLOT) return run_plot(j->ctx, a);
  if (a->command == COMMAND_CHECK) return run_check(j->ctx, a, &j->passes);
  TRY(fs_mesh_read_notes(j->ctx, a->mesh, &j->mesh, &j->notes));
  describe(j);
  j->seconds.read = (t = now()) - then, then = t;
  if (a->command == COMMAND_INFO) return print_info(j->ctx, a, j->mesh, &j->notes);
  if (a->command == COMMAND_REFINE) return run_refine(j);
  TRY(make_space(j));
  j->seconds.space = (t = now()) - then, then = t;
  if (a->command == COMMAND_FAIR)
    TRY(make_fair(j));
  else
    TRY(add_marks(j));
  j->seconds.fair = (t = now()) - then, then = t;
  TRY(write_outputs(j));
  j->seconds.export = (t = now()) - then;
  j->seconds.total = t - start;
  if (a->command == COMMAND_FAIR) {
    if (a->report != NULL) TRY(write_report(j->ctx, a->report, a, &j->report, &j->seconds));
    if (!a->quiet) print_report(stderr, a, &j->report, &j->seconds);
  }
  return FS_OK;
}

static void job_free(job *j) {
  fs_surface_free(j->ctx, j->surface);
  fs_surface_free(j->ctx, j->start);
  free_constraints(j->ctx, &j->constraints);
  fs_cap_notes_free(j->ctx, j->caps);
  fs_space_free(j->ctx, j->space);
  for (int32_t s = 0; s < j->n_steps; s++) fs_refinement_free(j->ctx, j->step[s]);
  fs_mesh_free(j->ctx, j->control);
  fs_mesh_free(j->ctx, j->mesh);
  fs_mesh_notes_clear(j->ctx, &j->notes);
  free(j->c);
  free(j->fixed);
}

int main(int argc, char **argv) {
  arguments arguments;
  parse_arguments(argc, argv, &arguments);
  fs_context ctx = {.progress = go_on,
                    .note = arguments.quiet ? NULL : print_note,
                    .n_threads = arguments.threads,
                    .max_bytes = 1e9 * arguments.max_memory};
  job j = {.ctx = &ctx, .arguments = &arguments, .passes = true};
  fs_status status;
  int code;
  use_large_pages(&ctx);
  signal(SIGINT, interrupt);
  fs_blas_set_threads(1);
  status = run(&j);
  code = exit_code(status);
  if (status != FS_OK) fprintf(stderr, "fairsurf: %s\n", ctx.message[0] != '\0' ? ctx.message : fs_status_text(status));
  if (status == FS_OK && j.report.stop == FS_STOP_CANCELLED) code = EXIT_CANCELLED;
  if (status == FS_OK && !j.passes) code = EXIT_FAILED;
  job_free(&j);
  fs_context_clear(&ctx);
  return code;
}
