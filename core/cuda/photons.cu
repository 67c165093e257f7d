/* The stages of the integrator photon: launches, and what becomes of their
 * counts. The sums of the field's cells and the field stay on the device. */
#include <cstdlib>
#include "core/cuda/backend.cuh"
extern "C" {
#include "core/radiance.h"
#include "lib/memory.h"
}

namespace
{

/* Photons of a warp: as many as fill a launch, but enough to be shared by its
 * threads and few enough for a stop to be heard soon. */
const uint64_t least_chunk = 32, most_chunk = 256;

const int block_size = 256;

uint64_t most_sources(const backend_frame *frame)
{
    return frame->flat->view.lights_count + 3;
}

uint64_t chunk_of(uint64_t photons)
{
    uint64_t chunk = photons / trace_warps + 1;
    return chunk < least_chunk  ? least_chunk
           : chunk > most_chunk ? most_chunk
                                : chunk;
}

void add_books(const photon_books *b, brume_photon_stats *out)
{
#define X(name) out->name += b->name;
    PHOTON_BOOKS(X)
#undef X
}

/* In the order of the warps. */
bool read_books(cuda_state *s, unsigned warps, brume_stats *out,
                brume_error *err)
{
    if (!device_check(cudaMemcpy(s->host_books, s->books,
                                 warps * sizeof *s->books,
                                 cudaMemcpyDeviceToHost),
                      "the trace stage", err))
        return false;
    for (unsigned i = 0; i < warps; i++)
        add_books(&s->host_books[i], &out->photons);
    return true;
}

bool read_totals(cuda_state *s, brume_stats *out, brume_error *err)
{
    photon_totals t;
    if (!device_check(
            cudaMemcpy(&t, s->total, sizeof t, cudaMemcpyDeviceToHost),
            "reading the counters", err))
        return false;
    cuda_add_track(&t.track, out);
    out->photons.traced += t.photons;
    out->photons.events += t.events;
    out->photons.bounces += t.bounces;
    out->photons.stored += t.stored;
    out->photons.clipped += t.clipped;
    return true;
}

/* The launch of photons [job->first, job->last). */
bool launch(cuda_state *s, const trace_job *job, brume_stats *stats,
            brume_error *err)
{
    uint64_t warps = (job->last - job->first + job->chunk - 1) / job->chunk;
    s->photons->trace(job, static_cast<unsigned>(warps));
    return device_check(cudaGetLastError(), "launching the trace stage", err) &&
           read_books(s, static_cast<unsigned>(warps), stats, err);
}

bool start(cuda_state *s, const photon_job *job, trace_job *out,
           brume_error *err)
{
    out->scene = s->job.scene;
    out->photons = *job;
    out->photons.source = s->source;
    out->chunk = chunk_of(job->count);
    out->sum = s->sum;
    out->total = s->total;
    out->books = s->books;
    size_t bytes = static_cast<size_t>(job->sources) * sizeof *s->source;
    return device_check(cudaMemcpy(s->source, job->source, bytes,
                                   cudaMemcpyHostToDevice),
                        "uploading the sources", err) &&
           device_check(cudaMemset(s->total, 0, sizeof *s->total),
                        "clearing the counters", err);
}

/* As radiance_resolve. */
__global__ void resolve(const int64_t *sum, float *cells, uint64_t count,
                        double scale)
{
    uint64_t i = static_cast<uint64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < count)
        cells[i] = static_cast<float>(static_cast<double>(sum[i]) * scale);
}

}

size_t photons_bytes(const backend_frame *frame)
{
    if (!frame->stages->photons)
        return 0;
    return device_round(radiance_sum_bytes(frame->flat)) +
           device_round(most_sources(frame) * sizeof(photon_source)) +
           device_round(sizeof(photon_totals)) +
           device_round(trace_warps * sizeof(photon_books));
}

bool photons_open(cuda_state *s, brume_error *err)
{
    if (!s->frame.stages->photons)
        return true;
    size_t bytes = radiance_sum_bytes(s->frame.flat);
    s->host_books = static_cast<photon_books *>(
        memory_new(trace_warps, sizeof *s->host_books, err));
    if (!s->host_books)
        return false;
    device_arena *a = &s->arena;
    s->sum = static_cast<int64_t *>(device_take(a, bytes));
    s->source = static_cast<photon_source *>(
        device_take(a, most_sources(&s->frame) * sizeof *s->source));
    s->total = static_cast<photon_totals *>(device_take(a, sizeof *s->total));
    s->books = static_cast<photon_books *>(
        device_take(a, trace_warps * sizeof *s->books));
    return device_check(cudaMemset(s->sum, 0, bytes), "clearing the field",
                        err);
}

void photons_close(cuda_state *s)
{
    free(s->host_books);
}

bool cuda_trace(void *state, const photon_job *job, brume_stats *stats,
                brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    trace_job t;
    if (!start(s, job, &t, err))
        return false;
    for (t.first = 0; t.first < job->count; t.first = t.last) {
        t.last = t.first + trace_warps * t.chunk;
        t.last = t.last < job->count ? t.last : job->count;
        if (!launch(s, &t, stats, err))
            return false;
        if (!s->frame.tick(s->frame.user, static_cast<double>(t.last) /
                                              static_cast<double>(job->count)))
            return true;
    }
    return read_totals(s, stats, err);
}

bool cuda_gather(void *state, double unit, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const radiance_lattice *f = &s->frame.flat->view.field;
    uint64_t count = s->frame.flat->view.radiance_count;
    uint64_t blocks = (count + block_size - 1) / block_size;
    cell_job job = {s->job.scene, s->job.pixels.seed, s->job.pixels.frame,
                    s->cells};
    if (count == 0)
        return true;
    if (unit > 0.0)
        resolve<<<static_cast<unsigned>(blocks), block_size>>>(
            s->sum, s->cells, count, radiance_scale(f, unit));
    if (unit > 0.0 && f->thick)
        s->photons->balls(&job);
    if (f->single)
        s->photons->light(&job);
    return device_check(cudaGetLastError(), "launching the gather stage",
                        err) &&
           device_check(cudaDeviceSynchronize(), "the gather stage", err);
}

bool cuda_take(void *state, float *cells, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    size_t bytes = s->frame.flat->view.radiance_count * sizeof *cells;
    return device_check(
        cudaMemcpy(cells, s->cells, bytes, cudaMemcpyDeviceToHost),
        "reading the field", err);
}

bool cuda_put(void *state, const float *cells, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    size_t bytes = s->frame.flat->view.radiance_count * sizeof *cells;
    return device_check(
        cudaMemcpy(s->cells, cells, bytes, cudaMemcpyHostToDevice),
        "writing the field", err);
}
