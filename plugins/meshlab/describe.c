/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: scripts for meshlabserver and the page of the manual from the table of filters.
   Usage: describe script FILTER [NAME=VALUE...]     FILTER: a part of its name; values as numbers, choices also as words
          describe manual */
#include "formats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- scripts ---------------------------------------------------------------------------------------------------------- */

static const filter *find_filter(const char *part) {
  for (int i = 0; filters[i] != NULL; i++)
    if (strstr(filters[i]->name, part) != NULL) return filters[i];
  fprintf(stderr, "describe: no filter has %s in its name\n", part);
  exit(2);
}

/* The value of a parameter: that of the last NAME=VALUE, or the initial one. */
static double value_of(const filter_param *p, int n, char **assignment) {
  double value = p->initial;
  size_t length = strlen(p->name);
  for (int i = 0; i < n; i++) {
    const char *text = assignment[i] + length + 1;
    if (strncmp(assignment[i], p->name, length) != 0 || assignment[i][length] != '=') continue;
    value = strtod(text, NULL);
    for (int32_t k = 0; p->kind == PARAM_CHOICE && param_choice(p, k) != NULL; k++)
      if (strcmp(text, param_choice(p, k)) == 0) value = k;
  }
  return value;
}

/* MeshLab 2020.09 wants every parameter, in the order of the filter. */
static void print_script_param(const filter_param *p, double value) {
  int32_t n = 0;
  switch (p->kind) {
  case PARAM_INTEGER:
    printf("  <Param type=\"RichInt\" value=\"%d\" name=\"%s\"/>\n", (int)value, p->name);
    break;
  case PARAM_NUMBER:
    printf("  <Param type=\"RichFloat\" value=\"%.9g\" name=\"%s\"/>\n", value, p->name);
    break;
  case PARAM_SLIDER:
    printf("  <Param type=\"RichDynamicFloat\" value=\"%.9g\" min=\"%.9g\" max=\"%.9g\" name=\"%s\"/>\n", value, p->min,
           p->max, p->name);
    break;
  case PARAM_SWITCH:
    printf("  <Param type=\"RichBool\" value=\"%s\" name=\"%s\"/>\n", value != 0 ? "true" : "false", p->name);
    break;
  case PARAM_CHOICE:
    while (param_choice(p, n) != NULL) n++;
    printf("  <Param type=\"RichEnum\" value=\"%d\" enum_cardinality=\"%d\"", (int)value, (int)n);
    for (int32_t k = 0; k < n; k++) printf(" enum_val%d=\"%s\"", (int)k, param_choice(p, k));
    printf(" name=\"%s\"/>\n", p->name);
    break;
  }
}

static void print_script(const filter *f, int n, char **assignment) {
  printf("<!DOCTYPE FilterScript>\n<FilterScript>\n <filter name=\"%s\">\n", f->name);
  for (const filter_param *p = f->params; p->name != NULL; p++) print_script_param(p, value_of(p, n, assignment));
  printf(" </filter>\n</FilterScript>\n");
}

/* ---- the manual --------------------------------------------------------------------------------------------------------- */

static void print_params(const filter_param *params) {
  printf("\n| parameter | in scripts | initially | |\n|---|---|---|---|\n");
  for (const filter_param *p = params; p->name != NULL; p++) {
    printf("| %s | `%s` | ", p->label, p->name);
    if (p->kind == PARAM_CHOICE)
      printf("%s", param_choice(p, (int32_t)p->initial));
    else if (p->kind == PARAM_SWITCH)
      printf("%s", p->initial != 0 ? "yes" : "no");
    else
      printf("%g", p->initial);
    printf(" | %s", p->help);
    for (int32_t k = 0; p->kind == PARAM_CHOICE && param_choice(p, k) != NULL; k++)
      printf("%s*%s*", k == 0 ? " One of " : ", ", param_choice(p, k));
    printf(" |\n");
  }
}

static void print_manual(void) {
  printf("# Filters and formats\n\nMade from the tables in `plugins/meshlab/` by `describe manual`.\n");
  for (int i = 0; filters[i] != NULL; i++) {
    printf("\n## %s\n\n%s\n\nIn PyMeshLab: `%s`.\n", filters[i]->name, filters[i]->help, filters[i]->python_name);
    print_params(filters[i]->params);
  }
  for (int i = 0; format_exporter(i) != NULL; i++) {
    filter_param params[MAX_FORMAT_PARAMS];
    const fs_exporter *e = format_exporter(i);
    format_list_params(e, params);
    printf("\n## File > Export Mesh As: .%s\n\n%s\n", e->extension, e->summary);
    print_params(params);
  }
}

int main(int argc, char **argv) {
  if (argc > 2 && strcmp(argv[1], "script") == 0)
    print_script(find_filter(argv[2]), argc - 3, argv + 3);
  else if (argc == 2 && strcmp(argv[1], "manual") == 0)
    print_manual();
  else
    return fputs("usage: describe script FILTER [NAME=VALUE...] | describe manual\n", stderr), 2;
  return 0;
}
