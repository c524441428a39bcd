/* SPDX-License-Identifier: MIT */
/* Single role: what the program is made of: the version with its BLAS, and the lines of the library's tables. */
#include "cli.h"

void print_version(void) {
  bool is_reference;
  const char *blas = fs_blas_name(&is_reference);
  printf("fairsurf %s\nBLAS: %s%s\n", fs_version(), blas,
         is_reference ? "\nwarning: this is the reference BLAS, several times slower: install libopenblas" : "");
}

void print_list(void) {
  printf("functionals:\n");
  for (int i = 0; fs_functionals[i] != NULL; i++)
    printf("  %-20s %s\n", fs_functionals[i]->name, fs_functionals[i]->summary);
  printf("patch rules:\n");
  for (int i = 0; fs_patch_rules[i] != NULL; i++)
    printf("  %-20s %s\n", fs_patch_rules[i]->name, fs_patch_rules[i]->summary);
  printf("refinements:\n");
  for (int i = 0; fs_refiners[i] != NULL; i++) printf("  %-20s %s\n", fs_refiners[i]->name, fs_refiners[i]->summary);
  printf("constructions:\n");
  for (int i = 0; fs_constructions[i] != NULL; i++)
    printf("  %-20s %s\n", fs_constructions[i]->name, fs_constructions[i]->summary);
  printf("plots:\n");
  for (int i = 0; fs_plots[i] != NULL; i++) printf("  %-20s %s\n", fs_plots[i]->name, fs_plots[i]->summary);
  printf("readers:\n");
  for (int i = 0; fs_readers[i] != NULL; i++) printf("  .%-19s %s\n", fs_readers[i]->extension, fs_readers[i]->summary);
  printf("readers of surfaces:\n");
  for (int i = 0; fs_surface_readers[i] != NULL; i++)
    printf("  .%-19s %s\n", fs_surface_readers[i]->extension, fs_surface_readers[i]->summary);
  printf("exporters:\n");
  for (int i = 0; fs_exporters[i] != NULL; i++)
    printf("  .%-19s %s\n", fs_exporters[i]->extension, fs_exporters[i]->summary);
  printf("measures:\n");
  for (int i = 0; fs_measures[i] != NULL; i++) printf("  %-20s %s\n", fs_measures[i]->name, fs_measures[i]->summary);
}
