/* A warp adds up a row's terms in their order: of 32 pixels at a time, which
 * its threads find side by side. */
#include "core/cuda/develop.cuh"
extern "C" {
#include "lib/thread.h"
}

namespace
{

const int warp = 32, block_warps = 4, block_size = warp * block_warps;

__global__ void survey_rows(const __grid_constant__ film_survey what,
                            const film_pixel *pixel, double *row)
{
    int32_t y = static_cast<int32_t>(blockIdx.x * block_warps +
                                     threadIdx.x / warp);
    int32_t lane = static_cast<int32_t>(threadIdx.x % warp);
    double sum = 0.0;
    if (y >= what.n.height)
        return;
    for (int32_t first = 0; first < what.n.width; first += warp) {
        int32_t x = first + lane;
        double term[3] = {};
        for (int c = 0; c < 3 && x < what.n.width; c++)
            term[c] = develop_term(&what, pixel, x, y, c);
        for (int k = 0; k < warp; k++)
            for (int c = 0; c < 3; c++)
                sum += __shfl_sync(0xffffffffu, term[c], k);
    }
    if (lane == 0)
        row[y] = sum;
}

__global__ void develop_pixels(const __grid_constant__ film_counts n,
                               const film_pixel *pixel, bool omit_background,
                               film_look *look)
{
    int64_t i = static_cast<int64_t>(blockIdx.x) * block_size + threadIdx.x;
    if (i < static_cast<int64_t>(n.width) * n.height)
        look[i] = develop_look(&n, pixel + i, omit_background);
}

void launch_rows(cuda_state *s, const film_survey *what)
{
    unsigned blocks = static_cast<unsigned>((what->n.height + block_warps - 1) /
                                            block_warps);
    if (blocks > 0)
        survey_rows<<<blocks, block_size>>>(*what, s->job.pixel, s->film_row);
}

/* To the planes: pieces of what has arrived. */
struct arrival {
    const film *f;
    size_t first, count;
    const film_look *look;
    brume_frame *frame;
};

const size_t piece = 4096; /* pixels */

void put_piece(void *context, size_t index, int thread)
{
    (void)thread;
    const arrival *a = static_cast<const arrival *>(context);
    size_t from = index * piece, left = a->count - from;
    film_put(a->f, a->first + from, left < piece ? left : piece, a->look + from,
             a->frame);
}

struct picture {
    cuda_state *s;
    brume_frame *frame;
};

void put_part(void *user, size_t from, const char *bytes, size_t count)
{
    const picture *p = static_cast<const picture *>(user);
    arrival a = {p->s->frame.film, from / sizeof(film_look),
                 count / sizeof(film_look),
                 reinterpret_cast<const film_look *>(bytes), p->frame};
    parallel_for(p->s->to.threads, (a.count + piece - 1) / piece, put_piece, &a,
                 nullptr);
}

}

size_t develop_bytes(const cuda_state *s)
{
    const film *f = s->frame.film;
    return device_round(film_pixels(f) * sizeof(film_look)) +
           device_round(static_cast<size_t>(f->y1 - f->y0) * sizeof(double));
}

void develop_open(cuda_state *s)
{
    const film *f = s->frame.film;
    s->film_look = static_cast<film_look *>(
        device_take(&s->arena, film_pixels(f) * sizeof *s->film_look));
    s->film_row = static_cast<double *>(device_take(
        &s->arena, static_cast<size_t>(f->y1 - f->y0) * sizeof *s->film_row));
}

/* As photons_warm. */
bool develop_warm(cuda_state *s, brume_error *err)
{
    film_survey none = {};
    survey_rows<<<1, block_size>>>(none, s->job.pixel, s->film_row);
    develop_pixels<<<1, block_size>>>(none.n, s->job.pixel, false,
                                      s->film_look);
    return device_wait("opening", err);
}

bool cuda_survey(void *state, const film_survey *what, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    launch_rows(s, what);
    return device_check(cudaGetLastError(), "looking at the film", err) &&
           device_check(
               cudaMemcpy(s->frame.film->row, s->film_row,
                          static_cast<size_t>(what->n.height) * sizeof(double),
                          cudaMemcpyDeviceToHost),
               "looking at the film", err);
}

bool cuda_develop(void *state, bool omit_background, brume_frame *frame,
                  brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const film *f = s->frame.film;
    size_t pixels = film_pixels(f);
    picture to = {s, frame};
    if (pixels == 0)
        return true;
    develop_pixels<<<static_cast<unsigned>((pixels + block_size - 1) /
                                           block_size),
                     block_size>>>(film_counts_of(f), s->job.pixel,
                                   omit_background, s->film_look);
    return device_check(cudaGetLastError(), "developing the film", err) &&
           upload_bring(&s->to, s->film_look, pixels * sizeof(film_look),
                        sizeof(film_look), put_part, &to, err);
}

bool cuda_fetch(void *state, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const film *f = s->frame.film;
    return device_check(cudaMemcpy(f->pixel, s->job.pixel,
                                   film_pixels(f) * sizeof *f->pixel,
                                   cudaMemcpyDeviceToHost),
                        "reading the film", err);
}
