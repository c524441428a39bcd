/* SPDX-License-Identifier: MIT */
/* Single role: parameters of the library's tables (functionals, refinements, constructions, plots, file formats) as options,
   and the values that hold for each output. */
#include "args.h"

#include <stdlib.h>
#include <string.h>

static void add_params(parser *p, const char *owner, const fs_param *params) {
  for (int i = 0; params != NULL && params[i].name != NULL; i++) {
    int32_t n = 0;
    char *doc;
    size_t used;
    while (n < p->n_names && strcmp(p->name[n].param->name, params[i].name) != 0) n++;
    if (n == MAX_NAMES) return;
    doc = p->name[n].doc;
    if (n < p->n_names) { /* another owner */
      used = strlen(doc);
      snprintf(doc + used, sizeof p->name[n].doc - used, "; %s: likewise", owner);
      continue;
    }
    p->name[p->n_names++].param = &params[i];
    used = (size_t)snprintf(doc, sizeof p->name[n].doc, "%s: %s", owner, params[i].summary);
    if (params[i].choices != NULL && used < sizeof p->name[n].doc)
      snprintf(doc + used, sizeof p->name[n].doc - used, " (%s)", params[i].choices[(int)params[i].initial]);
    else if (used < sizeof p->name[n].doc)
      snprintf(doc + used, sizeof p->name[n].doc - used, " (%g)", params[i].initial);
  }
}

void collect_params(parser *p) {
  for (int i = 0; fs_functionals[i] != NULL; i++) add_params(p, fs_functionals[i]->name, fs_functionals[i]->params);
  for (int i = 0; fs_refiners[i] != NULL; i++) add_params(p, fs_refiners[i]->name, fs_refiners[i]->params);
  for (int i = 0; fs_constructions[i] != NULL; i++)
    add_params(p, fs_constructions[i]->name, fs_constructions[i]->params);
  for (int i = 0; fs_plots[i] != NULL; i++) add_params(p, fs_plots[i]->name, fs_plots[i]->params);
  for (int i = 0; fs_exporters[i] != NULL; i++) add_params(p, fs_exporters[i]->name, fs_exporters[i]->params);
}

static bool parse_value(const fs_param *param, const char *text, double *value) {
  char *end;
  for (int i = 0; param->choices != NULL && param->choices[i] != NULL; i++)
    if (strcmp(param->choices[i], text) == 0) {
      *value = i;
      return true;
    }
  if (param->choices != NULL) return false;
  *value = strtod(text, &end);
  return end != text && *end == '\0' && *value >= param->min && *value <= param->max;
}

static void refuse_value(struct argp_state *state, const fs_param *param, const char *text) {
  char known[200] = "";
  for (int i = 0; param->choices != NULL && param->choices[i] != NULL; i++)
    snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i > 0 ? ", " : "", param->choices[i]);
  if (param->choices != NULL)
    argp_error(state, "--%s %s: choose one of %s", param->name, text, known);
  else
    argp_error(state, "--%s %s: a number from %g to %g is needed", param->name, text, param->min, param->max);
}

const char *setting(const parser *p, const char *name, int32_t at) {
  const char *text = NULL;
  for (int32_t i = 0; i < p->n_events; i++) {
    if (p->event[i].name < 0 || strcmp(p->name[p->event[i].name].param->name, name) != 0) continue;
    if (i < at || text == NULL) text = p->event[i].text;
  }
  return text;
}

static void fill_params(struct argp_state *state, const parser *p, const fs_param *params, int32_t at, double *value) {
  for (int i = 0; params != NULL && params[i].name != NULL && i < MAX_PARAM_VALUES; i++) {
    const char *text = setting(p, params[i].name, at);
    value[i] = params[i].initial;
    if (text != NULL && !parse_value(&params[i], text, &value[i])) refuse_value(state, &params[i], text);
  }
}

void finish_outputs(struct argp_state *state, parser *p) {
  arguments *a = p->arguments;
  for (int32_t i = 0; i < p->n_events; i++) {
    const event *e = &p->event[i];
    output_request *o;
    const char *dot;
    if (e->name >= 0) continue;
    if (a->n_outputs == MAX_OUTPUTS) argp_error(state, "more than %d outputs", MAX_OUTPUTS);
    o = &a->output[a->n_outputs++];
    *o = (output_request){.path = e->text, .is_surface = e->is_surface};
    o->colour = e->colour != NULL ? e->colour : p->first_colour;
    dot = strrchr(e->text, '.');
    o->exporter = dot != NULL && strchr(dot, '/') == NULL ? fs_exporter_find(dot + 1) : NULL;
    if (o->exporter == NULL) {
      char known[200] = "";
      for (int k = 0; fs_exporters[k] != NULL; k++)
        snprintf(known + strlen(known), sizeof known - strlen(known), " .%s", fs_exporters[k]->extension);
      argp_error(state, "-o %s: no exporter has this extension; there are%s", e->text, known);
    }
    fill_params(state, p, o->exporter->params, i, o->param);
  }
  fill_params(state, p, a->functional->params, p->n_events, a->functional_param);
  if (a->film != NULL || a->before_after != NULL)
    fill_params(state, p, fs_exporter_find("pov")->params, p->n_events, a->film_param);
  fill_params(state, p, a->plot->params, p->n_events, a->plot_param);
  fill_params(state, p, a->construction->params, p->n_events, a->construction_param);
  for (int i = 0; fs_refiners[i] != NULL; i++)
    if (strcmp(fs_refiners[i]->name, a->refiner) == 0)
      fill_params(state, p, fs_refiners[i]->params, p->n_events, a->refiner_param);
}
