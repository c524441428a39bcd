/* SPDX-License-Identifier: MIT */
/* Single role: the command line: its options, what each sets, and the help. */
#include "args.h"

#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *argp_program_bug_address = NULL;

enum {
  KEY_FIXED = 1000,
  KEY_REPORT,
  KEY_REFINE,
  KEY_NO_REFINE,
  KEY_NODES,
  KEY_ITERATIONS,
  KEY_THREADS,
  KEY_BLAS_THREADS,
  KEY_MAX_MEMORY,
  KEY_FUNCTIONAL,
  KEY_START,
  KEY_NAME,
  KEY_SURFACE,
  KEY_NET,
  KEY_JSON,
  KEY_SCHEME,
  KEY_CAPS,
  KEY_COLOUR,
  KEY_LIST,
  KEY_REQUIRE,
  KEY_WORST,
  KEY_COMPARE,
  KEY_CONSTRUCTION,
  KEY_KIND,
  KEY_NORMALS,
  KEY_POLISH,
  KEY_ALONG_NORMALS,
  KEY_MAX_TIME,
  KEY_STOP_DECREASE,
  KEY_EVERY,
  KEY_FILM,
  KEY_BEFORE_AFTER,
  KEY_PARAM = 2000 /* + number of a parameter in the list below */
};

/* ---- argp -------------------------------------------------------------------------------------------------------- */

static int32_t parse_integer(struct argp_state *state, const char *option, const char *text, int32_t min, int32_t max) {
  char *end;
  long value;
  errno = 0;
  value = strtol(text, &end, 10);
  if (end == text || *end != '\0' || errno != 0 || value < min || value > max)
    argp_error(state, "--%s %s: a whole number from %d to %d is needed", option, text, min, max);
  return (int32_t)value;
}

static double parse_real(struct argp_state *state, const char *option, const char *text, double min, double max) {
  char *end;
  double value = strtod(text, &end);
  if (end == text || *end != '\0' || !(value >= min && value <= max))
    argp_error(state, "--%s %s: a number from %g to %g is needed", option, text, min, max);
  return value;
}

static void add_event(struct argp_state *state, parser *p, event e) {
  if (p->n_events == MAX_EVENTS) argp_error(state, "more than %d settings and outputs", MAX_EVENTS);
  p->event[p->n_events++] = e;
}

static command command_of(const char *text) {
  static const struct {
    const char *name;
    command command;
  } known[] = {{"info", COMMAND_INFO},   {"refine", COMMAND_REFINE}, {"fair", COMMAND_FAIR}, {"export", COMMAND_EXPORT},
               {"patch", COMMAND_PATCH}, {"check", COMMAND_CHECK},   {"plot", COMMAND_PLOT}};
  for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
    if (strcmp(known[i].name, text) == 0) return known[i].command;
  return COMMAND_NONE;
}

/* --tolerance is a parameter of exporters too. */
static void finish_check(struct argp_state *state, parser *p) {
  const char *text = setting(p, "tolerance", p->n_events);
  char *end;
  if (text == NULL) return;
  p->arguments->tolerance = strtod(text, &end);
  if (end == text || *end != '\0' || !(p->arguments->tolerance >= 0) || !isfinite(p->arguments->tolerance))
    argp_error(state, "--tolerance %s: a number from 0 on is needed", text);
}

static int32_t parse_order(struct argp_state *state, const char *text) {
  if ((text[0] == 'g' || text[0] == 'G') && text[1] >= '0' && text[1] <= '3' && text[2] == '\0') return text[1] - '0';
  argp_error(state, "--require %s: choose one of g0, g1, g2, g3", text);
  return -1;
}

static void finish(struct argp_state *state, parser *p) {
  arguments *a = p->arguments;
  if (a->command == COMMAND_NONE)
    argp_error(state, "a command is needed: info, refine, fair, export, patch, plot or check");
  if (a->mesh == NULL) argp_error(state, "a mesh is needed");
  finish_outputs(state, p);
  if (a->command == COMMAND_EXPORT && a->n_outputs == 0) argp_error(state, "export needs an output: -o FILE");
  if (a->command == COMMAND_PATCH && a->n_outputs == 0) argp_error(state, "patch needs an output: -o FILE");
  if (a->command == COMMAND_PLOT && a->n_outputs == 0) argp_error(state, "plot needs an output: -o FILE");
  if (a->command == COMMAND_REFINE && a->n_outputs == 0) argp_error(state, "refine needs an output: -o FILE");
  if (a->command == COMMAND_CHECK) finish_check(state, p);
  if (a->no_refine && a->refine > 0) argp_error(state, "--refine and --no-refine exclude each other");
}

static int32_t parse_caps(struct argp_state *state, const char *text) {
  static const char *const names[] = {
      [FS_CAPS_LINEAR] = "linear", [FS_CAPS_SMOOTH] = "smooth", [FS_CAPS_FULL] = "full"};
  for (int32_t i = 0; i < (int32_t)(sizeof names / sizeof *names); i++)
    if (strcmp(names[i], text) == 0) return i;
  argp_error(state, "--caps %s: choose one of linear, smooth, full", text);
  return -1;
}

/* Parameters of one letter are short options too. */
static int key_of(const parser *p, int32_t i) {
  const char *name = p->name[i].param->name;
  return name[1] == '\0' ? name[0] : KEY_PARAM + i;
}

static error_t parse_option(int key, char *text, struct argp_state *state) {
  parser *p = state->input;
  arguments *a = p->arguments;
  for (int32_t i = 0; i < p->n_names; i++)
    if (key == key_of(p, i)) {
      add_event(state, p, (event){.name = i, .text = text});
      return 0;
    }
  switch (key) {
  case ARGP_KEY_INIT:
    state->child_inputs[0] = &a->constraints;
    break;
  case 'o':
    add_event(state, p, (event){.name = -1, .text = text, .is_surface = p->is_surface, .colour = p->colour});
    break;
  case 'q':
    a->quiet = true;
    break;
  case 'V':
    print_version();
    exit(0);
  case KEY_LIST:
    print_list();
    exit(0);
  case KEY_REQUIRE:
    a->require = parse_order(state, text);
    break;
  case KEY_WORST:
    a->worst = parse_integer(state, "worst", text, 1, 10000);
    break;
  case KEY_COMPARE:
    a->compare = text;
    break;
  case KEY_CONSTRUCTION:
    a->construction = fs_construction_find(text);
    if (a->construction == NULL)
      argp_error(state, "--construction %s is unknown; fairsurf --list shows the known ones", text);
    a->is_constructed = true;
    break;
  case KEY_KIND:
    a->plot = fs_plot_find(text);
    if (a->plot == NULL) argp_error(state, "--kind %s is unknown; fairsurf --list shows the known plots", text);
    break;
  case KEY_NORMALS:
    a->normals = text;
    break;
  case KEY_FIXED:
    a->fixed = text;
    break;
  case KEY_REPORT:
    a->report = text;
    break;
  case KEY_REFINE:
    a->refine = parse_integer(state, "refine", text, 0, FS_MAX_REFINEMENTS - 2);
    break;
  case KEY_NO_REFINE:
    a->no_refine = true;
    break;
  case KEY_NODES:
    a->nodes = parse_integer(state, "nodes", text, 1, 32);
    break;
  case KEY_ITERATIONS:
    a->max_iterations = parse_integer(state, "max-iterations", text, 0, INT_MAX);
    break;
  case KEY_POLISH:
    a->polish = true;
    break;
  case KEY_ALONG_NORMALS:
    a->along_normals = true;
    break;
  case KEY_MAX_TIME:
    a->max_seconds = parse_real(state, "max-time", text, 1e-3, 1e9);
    break;
  case KEY_STOP_DECREASE:
    a->stop_decrease = parse_real(state, "stop-decrease", text, 1e-15, 1);
    break;
  case KEY_EVERY:
    a->every = text;
    break;
  case KEY_FILM:
    a->film = text;
    break;
  case KEY_BEFORE_AFTER:
    a->before_after = text;
    break;
  case KEY_THREADS:
    a->threads = parse_integer(state, "threads", text, 1, 64);
    break;
  case KEY_MAX_MEMORY:
    a->max_memory = parse_real(state, "max-memory", text, 1e-6, 1e6);
    break;
  case KEY_BLAS_THREADS:
    a->blas_threads = parse_integer(state, "blas-threads", text, 1, 64);
    break;
  case KEY_FUNCTIONAL:
    a->functional = fs_functional_find(text);
    if (a->functional == NULL)
      argp_error(state, "--functional %s is unknown; fairsurf --list shows the known ones", text);
    break;
  case KEY_START:
    if (strcmp(text, "triharmonic") != 0 && strcmp(text, "mesh") != 0)
      argp_error(state, "--start %s: choose one of mesh, triharmonic", text);
    a->start_triharmonic = strcmp(text, "triharmonic") == 0;
    break;
  case KEY_NAME:
    a->name = text;
    break;
  case KEY_SURFACE:
    p->is_surface = true;
    break;
  case KEY_NET:
    p->is_surface = false;
    break;
  case KEY_JSON:
    a->json = true;
    break;
  case KEY_SCHEME:
    a->refiner = text;
    break;
  case KEY_CAPS:
    a->caps = parse_caps(state, text);
    break;
  case KEY_COLOUR:
    p->colour = fs_measure_find(text);
    if (p->colour == NULL) argp_error(state, "--colour %s is unknown; fairsurf --list shows the known measures", text);
    if (p->first_colour == NULL) p->first_colour = p->colour;
    break;
  case ARGP_KEY_ARG:
    if (state->arg_num == 0) {
      a->command = command_of(text);
      if (a->command == COMMAND_NONE)
        argp_error(state, "unknown command %s: info, refine, fair, export, patch, plot and check are known", text);
    } else if (state->arg_num == 1) {
      a->mesh = text;
    } else {
      argp_error(state, "%s: one mesh at a time", text);
    }
    break;
  case ARGP_KEY_END:
    finish(state, p);
    break;
  default:
    return ARGP_ERR_UNKNOWN;
  }
  return 0;
}

static const struct argp_option fixed_options[] = {
    {NULL, 0, NULL, 0, "Output:", 1},
    {"output", 'o', "FILE", 0, "write FILE; its extension chooses the exporter; may be given often", 0},
    {"surface", KEY_SURFACE, NULL, 0, "the -o that follow hold the tessellated surface (.stl and .pov always do)", 0},
    {"net", KEY_NET, NULL, 0, "the -o that follow hold the control net, as at the beginning", 0},
    {"name", KEY_NAME, "NAME", 0, "name of the object in the files (default: stem of the file)", 0},
    {"colour", KEY_COLOUR, "MEASURE", 0, "colour by a measure: mean, gaussian, … (see --list)", 0},
    {"report", KEY_REPORT, "FILE", 0, "write the report of fairing as JSON", 0},
    {"json", KEY_JSON, NULL, 0, "info, check: print JSON", 0},
    {"quiet", 'q', NULL, 0, "no notes, no progress, no report", 0},
    {NULL, 0, NULL, 0, "The mesh and its space:", 2},
    {"refine", KEY_REFINE, "N", 0, "refine N times at least; without it only where the space needs it", 0},
    {"no-refine", KEY_NO_REFINE, NULL, 0, "refuse a mesh that would need refinement", 0},
    {"scheme", KEY_SCHEME, "NAME", 0, "refine: averaging or catmull-clark", 0},
    {"caps", KEY_CAPS, "KIND", 0,
     "inner coefficients of caps: linear (none), smooth, full; default: those of the file, and for fair full ones with "
     "functionals that lower C in steps",
     0},
    {NULL, 0, NULL, 0, "Fairing:", 3},
    {"functional", KEY_FUNCTIONAL, "NAME", 0, "what to minimise (default: the first of --list)", 0},
    {"fixed", KEY_FIXED, "FILE", 0, "vertices that stay besides the rim: numbers from 0, one per line", 0},
    {"start", KEY_START, "WHAT", 0, "mesh: the given positions; triharmonic: the minimum of a linear problem", 0},
    {"nodes", KEY_NODES, "N", 0, "Gauss nodes per direction, everywhere (default: 8 on squares, 12 in caps)", 0},
    {"max-iterations", KEY_ITERATIONS, "N", 0, "steps at most (300, or 400 with --stay-within); 0 only measures", 0},
    {"polish", KEY_POLISH, NULL, 0, "go on with a hundredth of C: a little fairer, takes longer", 0},
    {"along-normals", KEY_ALONG_NORMALS, NULL, 0,
     "move vertices along the normals only: keeps the parametrisation, the result depends on the start", 0},
    {"max-time", KEY_MAX_TIME, "SECONDS", 0, "stop after so many seconds with the best surface so far", 0},
    {"stop-decrease", KEY_STOP_DECREASE, "PART", 0, "stop when a step promises less than this part of the functional",
     0},
    {"every", KEY_EVERY, "FOLDER", 0, "write every iterate as FOLDER/iter0000.ply, …", 0},
    {"film", KEY_FILM, "FOLDER", 0, "write a POV-Ray scene of every iterate; film.ini in FOLDER renders all", 0},
    {"before-after", KEY_BEFORE_AFTER, "FOLDER", 0,
     "write POV-Ray scenes of the start and of the result, alone and beside "
     "each other: before_after.pov in FOLDER",
     0},
    {"threads", KEY_THREADS, "N", 0, "threads (1)", 0},
    {"blas-threads", KEY_BLAS_THREADS, "N", 0, "threads of the linear algebra (1); always 1 below 5000 vertices", 0},
    {"max-memory", KEY_MAX_MEMORY, "GB", 0, "stop before a factorisation would take more (default: what is available)",
     0},
    {NULL, 0, NULL, 0, "Patches:", 4},
    {"construction", KEY_CONSTRUCTION, "NAME", 0,
     "how patch makes the surface (default: the first of --list); check: measure the surface that patch makes so", 0},
    {"normals", KEY_NORMALS, "FILE", 0, "patch: a normal per line, x y z, in the order of the vertices", 0},
    {NULL, 0, NULL, 0, "Checking:", 4},
    {"require", KEY_REQUIRE, "ORDER", 0,
     "g0, g1, g2 or g3 with --tolerance X (1e-6): exit with 5 where edges or vertices miss it", 0},
    {"worst", KEY_WORST, "N", 0, "length of the lists of the worst edges (10)", 0},
    {"compare", KEY_COMPARE, "START", 0, "measure START too, and say how the surface differs", 0},
    {NULL, 0, NULL, 0, "Plots:", 4},
    {"kind", KEY_KIND, "NAME", 0, "which curves plot draws (default: the first of --list)", 0},
    {NULL, 0, NULL, 0, "About:", 9},
    {"list", KEY_LIST, NULL, 0, "list functionals, rules, refinements, constructions, formats, measures", 0},
    {"version", 'V', NULL, 0, "print the version and the BLAS in use", 0},
};
enum { N_FIXED_OPTIONS = sizeof fixed_options / sizeof fixed_options[0] };

void parse_arguments(int argc, char **argv, arguments *a) {
  static const char doc[] =
      "Turns a polygon control mesh into a fair, curvature continuous surface.\v"
      "Commands:\n"
      "  info MESH     counts, valences, and what a space over the mesh would be made of\n"
      "  refine MESH   one refinement step of the mesh\n"
      "  fair MESH     move the free vertices to the fairest surface, write it\n"
      "  export MESH   write the surface as it is\n"
      "  patch MESH    write a surface through the vertices, made without fairing\n"
      "  plot MESH     draw isophotes, zebra, lines of curvature, sections, … on the surface as it is\n"
      "  check FILE    measure how smoothly patches meet, curvatures, energies, self-intersections; FILE is a mesh or "
      "holds\n"
      "                patches; an -o shows the jumps as colours\n\n"
      "Options of a file format hold for the -o that follow them; where none came before an -o, the first one on the "
      "line "
      "holds. Exit codes: 0 done, 1 the input is refused, 2 usage, 3 numeric failure, 4 files, 5 check: what is "
      "required is "
      "missing, 130 cancelled (the best surface so far is written).";
  parser p = {.arguments = a};
  struct argp_option options[N_FIXED_OPTIONS + MAX_NAMES + 2] = {{0}};
  int n = 0;
  *a = (arguments){.functional = fs_functionals[0],
                   .construction = fs_constructions[0],
                   .plot = fs_plots[0],
                   .refiner = "averaging",
                   .max_iterations = -1,
                   .threads = 1,
                   .blas_threads = 1,
                   .require = -1,
                   .tolerance = 1e-6,
                   .caps = -1};
  collect_params(&p);
  for (int i = 0; i < N_FIXED_OPTIONS; i++) options[n++] = fixed_options[i];
  options[n++] = (struct argp_option){
      .doc = "Parameters (of functionals, refinements, constructions, plots, file formats):", .group = 5};
  for (int32_t i = 0; i < p.n_names; i++) {
    options[n++] =
        (struct argp_option){.name = p.name[i].param->name, .key = key_of(&p, i), .arg = "VALUE", .doc = p.name[i].doc};
  }
  const struct argp_child children[] = {{&constraint_argp, 0, "Constraints of fair:", 3}, {0}};
  const struct argp argp = {
      .options = options, .parser = parse_option, .args_doc = "COMMAND MESH", .doc = doc, .children = children};
  argp_err_exit_status = EXIT_USAGE;
  argp_parse(&argp, argc, argv, 0, NULL, &p);
}
