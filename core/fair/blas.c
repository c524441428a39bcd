/* SPDX-License-Identifier: MIT */
/* Single role: which BLAS the solver runs on, and on how many threads. The reference BLAS, which libblas gives where nothing better is installed,
   makes factorisations several times slower. */
#include <fairsurf/fair.h>

#include <dlfcn.h>
#include <string.h>

const char *fs_blas_name(bool *is_reference) {
  Dl_info info;
  const char *name = "unknown BLAS";
  bool is_known_fast = dlsym(RTLD_DEFAULT, "openblas_get_config") != NULL ||
                       dlsym(RTLD_DEFAULT, "MKL_Get_Version_String") ||
                       dlsym(RTLD_DEFAULT, "bli_info_get_version_str") || dlsym(RTLD_DEFAULT, "ATL_buildinfo");
  void *product = dlsym(RTLD_DEFAULT, "dgemm_");
  if (product != NULL && dladdr(product, &info) != 0 && info.dli_fname != NULL) name = info.dli_fname;
  if (is_reference != NULL) *is_reference = !is_known_fast;
  return name;
}

/* ISO C has no cast from an object to a function. */
static void call_if_there(const char *name, int argument) {
  void *address = dlsym(RTLD_DEFAULT, name);
  void (*function)(int) = NULL;
  if (address == NULL) return;
  memcpy(&function, &address, sizeof function);
  function(argument);
}

void fs_blas_set_threads(int32_t n_threads) {
  call_if_there("openblas_set_num_threads", (int)n_threads);
  /* CHOLMOD asks OpenMP for four threads whatever the machine; without active levels it gets one */
  call_if_there("omp_set_max_active_levels", n_threads > 1);
}
