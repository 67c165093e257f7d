/* develop.cuh - the film on the device: its error and its picture are found
 * there, so that its pixels need not come to the host. */
#ifndef CORE_CUDA_DEVELOP_CUH
#define CORE_CUDA_DEVELOP_CUH
#include "core/cuda/backend.cuh"

/* Bytes of the device that these need. */
size_t develop_bytes(const cuda_state *s);
/* Takes them. */
void develop_open(cuda_state *s);
bool develop_warm(cuda_state *s, brume_error *err);

bool cuda_survey(void *state, const film_survey *what, brume_error *err);
bool cuda_develop(void *state, bool omit_background, brume_frame *frame,
                  brume_error *err);
bool cuda_fetch(void *state, brume_error *err);
#endif
