/* SPDX-License-Identifier: MIT */
/* The command line while it is parsed. */
#ifndef CLI_ARGS_H
#define CLI_ARGS_H

#include "cli.h"

#include <argp.h>

/* A parameter name of the tables; several exporters may share one. */
enum { MAX_NAMES = 128, MAX_EVENTS = 256 };
typedef struct named_param {
  const fs_param *param;
  char doc[200];
} named_param;

/* Settings and -o in the order in which they came. */
typedef struct event {
  int32_t name; /* of a parameter, or -1: an output */
  const char *text;
  bool is_surface;
  const fs_measure *colour;
} event;

typedef struct parser {
  arguments *arguments;
  int32_t n_names, n_events;
  named_param name[MAX_NAMES];
  event event[MAX_EVENTS];
  bool is_surface;
  const fs_measure *colour, *first_colour;
} parser;

/* The names of the tables' parameters. */
void collect_params(parser *p);

/* The setting of a parameter that holds at event `at`: the last before it, or else the first of the line. */
const char *setting(const parser *p, const char *name, int32_t at);

/* Outputs and parameters of the arguments from the events; a value that does not fit ends the program with a message. */
void finish_outputs(struct argp_state *state, parser *p);

#endif
