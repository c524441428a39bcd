/* SPDX-License-Identifier: MIT */
/* What the files of the command line share. They use the public headers only. */
#ifndef FS_CLI_CLI_H
#define FS_CLI_CLI_H

#include <fairsurf/fairsurf.h>
#include <stdio.h>
#include "constraints.h"

enum { EXIT_REFUSED = 1, EXIT_USAGE = 2, EXIT_NUMERIC = 3, EXIT_FILE = 4, EXIT_FAILED = 5, EXIT_CANCELLED = 130 };
enum { MAX_OUTPUTS = 64, MAX_PARAM_VALUES = 24 };

typedef enum command {
  COMMAND_NONE,
  COMMAND_INFO,
  COMMAND_REFINE,
  COMMAND_FAIR,
  COMMAND_EXPORT,
  COMMAND_PATCH,
  COMMAND_PLOT,
  COMMAND_CHECK
} command;

/* One -o, with the settings that hold for it. */
typedef struct output_request {
  const char *path;
  bool is_surface; /* --surface came before it */
  const fs_exporter *exporter;
  double param[MAX_PARAM_VALUES]; /* of the exporter */
  const fs_measure *colour;       /* or NULL */
} output_request;

typedef struct arguments {
  command command;
  const char *mesh;
  int32_t n_outputs;
  output_request output[MAX_OUTPUTS];
  const char *name;           /* of the object in the files, or NULL: the stem */
  const char *fixed, *report; /* files, or NULL */
  const char *every;          /* folder for every iterate, or NULL */
  const char *film;           /* likewise for their scenes */
  const char *before_after;   /* folder for a scene of the first and the last, or NULL */
  double film_param[MAX_PARAM_VALUES];
  bool json, no_refine, quiet, start_triharmonic, polish, along_normals;
  double max_seconds, stop_decrease; /* 0: no limit, that of the library */
  int32_t refine, nodes, threads, blas_threads;
  double max_memory;      /* GB for factorisations; 0: what is available */
  int32_t max_iterations; /* 0 only measures; -1: as many as the library thinks fit */
  int32_t caps;           /* one of fs_cap_inner, or -1: what suits the functional and the file */
  const char *refiner;    /* of the command refine */
  double refiner_param[MAX_PARAM_VALUES];
  const fs_functional *functional;
  double functional_param[MAX_PARAM_VALUES];
  constraint_arguments constraints;
  const fs_construction *construction; /* of the command patch */
  bool is_constructed;                 /* --construction was given: check measures what patch makes */
  double construction_param[MAX_PARAM_VALUES];
  const fs_plot *plot; /* of the command plot */
  double plot_param[MAX_PARAM_VALUES];
  const char *normals; /* file, or NULL */
  int32_t require;     /* of the command check: the order of continuity, or -1 */
  int32_t worst;       /* length of its lists */
  double tolerance;
  const char *compare; /* file, or NULL */
} arguments;

/* Fills the arguments or leaves the program: 0 after --help and --version, 2 with a sentence where they are wrong. */
void parse_arguments(int argc, char **argv, arguments *arguments);

void print_version(void); /* with the BLAS in use */
void print_list(void);    /* of the tables of the library */

/* Exit code of a status. */
int exit_code(fs_status status);

/* Lets ctx, and CHOLMOD, ask for large pages and keep what was freed. */
void use_large_pages(fs_context *ctx);

/* The space over a mesh with the caps that the arguments ask for, or that suit. kept: coefficients that the file holds, or
   NULL; they are for the mesh as it was read, before it was refined. */
fs_status create_space(fs_context *ctx, const arguments *arguments, const fs_mesh *mesh, const fs_cap_notes *kept,
                       bool is_refined, fs_space **space);
void note_lost_caps(fs_context *ctx, const fs_cap_notes *kept); /* by refinement; NULL: nothing */

/* What the command info prints. */
fs_status print_info(fs_context *ctx, const arguments *arguments, const fs_mesh *mesh, const fs_mesh_notes *notes);

/* The surface that a file holds, or that its control net gives. */
fs_status load_surface(fs_context *ctx, const arguments *arguments, const char *path, fs_surface **surface);
/* With its control net, where it has one; all zero at the start. */
typedef struct loaded_surface {
  fs_surface *surface;
  fs_mesh *control;
  fs_cap_notes *caps;
} loaded_surface;
fs_status load_with_net(fs_context *ctx, const arguments *arguments, const char *path, loaded_surface *loaded);
void free_loaded(fs_context *ctx, loaded_surface *loaded);

/* The command check. passes: whether the required continuity is there, or none was required. */
fs_status run_check(fs_context *ctx, const arguments *arguments, bool *passes);

void put_string(FILE *file, const char *text); /* as a string of JSON */

/* The command patch. */
/* The surface of the command patch, by arguments->construction from the file arguments->mesh. The caller frees it. */
fs_status construct_surface(fs_context *ctx, const arguments *arguments, fs_surface **surface);
fs_status run_patch(fs_context *ctx, const arguments *arguments);

/* The command plot. */
fs_status run_plot(fs_context *ctx, const arguments *arguments);

/* marked[n_vertices] from a file of marks: one vertex number per line, counted from 0, alone or followed by "fixed" or
   "free"; # starts a comment. */
fs_status read_marks(fs_context *ctx, const char *path, int32_t n_vertices, bool *marked);

typedef struct timings {
  double read, space, fair, export, total;
} timings;

/* The report of fairing as JSON, 17 digits; written beside and renamed. */
fs_status write_report(fs_context *ctx, const char *path, const arguments *arguments, const fs_fair_report *report,
                       const timings *seconds);
void print_report(FILE *file, const arguments *arguments, const fs_fair_report *report, const timings *seconds);

/* Every iterate as a file: what --every and --film ask for. */
typedef struct iterates {
  const char *folder; /* NULL: none */
  const fs_mesh *mesh;
  const fs_space *space;
  const char *film;         /* folder for the scenes of a film, or NULL */
  const double *film_param; /* of their exporter */
  int32_t n_frames;
  fs_status status; /* of the first file that could not be written */
} iterates;
fs_status begin_iterates(fs_context *ctx, const iterates *iterates); /* makes the folders that are not there */
bool write_iterate(fs_context *ctx, iterates *iterates, const fs_step *step, const fs_vec3 *c); /* false: not written */

/* Files of several names in one folder. */
fs_status make_folder(fs_context *ctx, const char *path); /* where it is not there; NULL: none */
fs_status export_into(fs_context *ctx, const fs_model *model, const double *param, const char *folder,
                      const char *name);
fs_status write_text(fs_context *ctx, const char *folder, const char *name, const char *text);

/* folder/before_after.pov: two surfaces beside each other, from before.inc and after.inc that declare the object. */
fs_status write_pair(fs_context *ctx, const char *folder, const char *object, const char *before, const char *after);
/* What --before-after asks for: those files, and the pair. */
fs_status write_before_after(fs_context *ctx, const arguments *arguments, const fs_surface *before,
                             const fs_surface *after);

fs_status write_frame(fs_context *ctx, iterates *iterates, const fs_vec3 *c);
fs_status end_film(fs_context *ctx, iterates *iterates); /* the scenes that show them all */

double now(void); /* seconds of a steady clock */

#endif
