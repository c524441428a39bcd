/* SPDX-License-Identifier: MIT */
/* What all tests share: contexts, an allocator that counts and fails on request, random numbers, meshes, shared files. */
#ifndef FS_TEST_SUPPORT_H
#define FS_TEST_SUPPORT_H

#include <fairsurf/mesh.h>

enum { TEST_SKIPPED = 77 }; /* exit code of a test whose data are not there */

/* Sanitizers look at memory and make numbers slow. What repeats the same code for other numbers is left to other builds. */
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
enum { TEST_IS_SANITIZED = 1 };
#elif defined __has_feature
enum { TEST_IS_SANITIZED = __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) };
#else
enum { TEST_IS_SANITIZED = 0 };
#endif

fs_context test_context(void);

/* Counts blocks and bytes of a context, can fail one allocation, and keeps the notes of the library. */
struct test_memory {
  int64_t fail_at;       /* number of the allocation to fail, from 1; 0: none */
  int64_t n_allocations; /* asked for so far, the failed one included */
  int64_t n_live;        /* blocks not yet released; 0 at the end where nothing leaks */
  size_t live_bytes, peak_bytes;
  int32_t n_notes;
  char note[512]; /* the last one */
};
fs_context test_memory_context(struct test_memory *memory); /* memory must outlive the context */

/* Deterministic random numbers (splitmix64); the state may start anywhere. */
uint64_t test_random(uint64_t *state);
double test_random_real(uint64_t *state, double min, double max);
int32_t test_random_integer(uint64_t *state, int32_t min, int32_t max); /* both included */

/* Path of a file below the folder of the environment variable FAIRSURF_SHARED, in a static buffer. NULL, with a message
   on stderr, where the variable or the file is absent: then the test exits with TEST_SKIPPED. */
const char *test_shared(const char *relative);

char *test_file(const char *path, size_t *size); /* whole file and a zero byte behind it; the caller frees with free */
fs_mesh *test_shared_mesh(const char *name);     /* of "meshes/NAME.obj"; NULL as test_shared */

/* fs_mesh_parse of a copy of just that size, so that a sanitizer sees every byte read beyond it. */
fs_status test_parse(fs_context *ctx, const char *extension, const char *bytes, size_t size, fs_mesh **mesh);

/* Meshes, all made with malloc: fs_mesh_free with any context that has no allocator of its own.
   They end the program where the mesh is not accepted. */
fs_mesh *test_mesh(int32_t n_vertices, const fs_vec3 *position, int32_t n_faces, const int32_t *face_start,
                   const int32_t *corner);
fs_mesh *test_cube(void);       /* [-1, 1]^3, 6 quads */
fs_mesh *test_prism(int32_t k); /* closed: two k-gons and k quads; all valences are 3 */

/* nx x ny unit quads in the plane, vertex (i, j) is number i + (nx + 1) j at (i, j, z(i, j)); z NULL: 0. */
fs_mesh *test_grid(int32_t nx, int32_t ny, double (*z)(double x, double y));

/* n quads along the large circle of radius R about the z axis times m around the tube of radius r; outside is outside. */
fs_mesh *test_torus(int32_t n, int32_t m, double R, double r);

/* Vertex 0 of valence k >= 3 in the middle of k sectors of rings x rings quads over the plane, on the saddle
   z = (x^2 - y^2) / (5 rings); k rings (rings + 1) + 1 vertices, in sector s at i e(s) + j e(s + 1), i >= 1, j >= 0. */
fs_mesh *test_star(int32_t k, int32_t rings);

fs_mesh *test_random_mesh(uint64_t seed); /* one of the above with random sizes; vertices moved a little, mostly */

/* Moves every coordinate by a random number of [-amount, amount]. */
void test_mesh_disturb(fs_mesh *mesh, double amount, uint64_t *state);

#endif
