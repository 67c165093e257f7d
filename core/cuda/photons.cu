/* The stages of the integrator photon: launches, and what becomes of their
 * counts. The sums of the field's cells and the field stay on the device. */
#include "core/cuda/backend.cuh"
#include "core/cuda/count.cuh"
#include "core/physics/half.h"
extern "C" {
#include "core/radiance.h"
}

namespace
{

/* Photons of a launch, at most: many for each thread, few enough for a stop to
 * be heard soon, and for the memory. */
const uint64_t most_photons = 1u << 20;

const int block_size = 256;

uint64_t most_sources(const backend_frame *frame)
{
    return frame->flat->view.lights_count + 3;
}

uint64_t born_at_once(const backend_frame *frame)
{
    uint64_t count = photons_asked(frame->options);
    return count < most_photons ? count : most_photons;
}

/* As many as run at once, or have photons. */
unsigned trace_blocks(const cuda_state *s)
{
    uint64_t threads = static_cast<uint64_t>(s->trace_threads);
    uint64_t needed = (born_at_once(&s->frame) + threads - 1) / threads;
    uint64_t most = static_cast<uint64_t>(s->processors) *
                    static_cast<uint64_t>(s->tracer->threads *
                                          s->tracer->blocks) /
                    threads;
    return static_cast<unsigned>(needed < most ? needed : most);
}

/* Photons that a list has room for. */
uint64_t list_room(const cuda_state *s)
{
    return born_at_once(&s->frame) +
           trace_blocks(s) * static_cast<uint64_t>(s->trace_threads);
}

size_t list_bytes(const cuda_state *s)
{
    return device_round(list_room(s) * s->births->state_bytes);
}

size_t ring_bytes(const cuda_state *s)
{
    return device_round(s->tracer->ring_bytes *
                        static_cast<size_t>(s->processors));
}

/* Bytes of a list of all the field's cells, where some are looked for. */
size_t cell_list_bytes(const backend_frame *frame)
{
    const flat_scene *view = &frame->flat->view;
    const radiance_lattice *f = &view->field;
    return f->ball || f->single || f->lit
               ? view->radiance_count / static_cast<size_t>(f->numbers) *
                     sizeof(uint64_t)
               : 0;
}

double book_of(unsigned long long sum)
{
    return static_cast<double>(static_cast<int64_t>(sum)) / PHOTON_BOOK_ONE;
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
#define X(name) out->photons.name += book_of(t.name);
    PHOTON_BOOKS(X)
#undef X
    return true;
}

bool launch(cuda_state *s, const trace_job *job, brume_error *err)
{
    device_clock_mark(&s->clock, 0);
    s->births->bear(job);
    return device_check(cudaGetLastError(), "launching births", err) &&
           device_check(
               s->tracer->trace(job, trace_blocks(s), s->trace_threads),
               "launching the trace stage", err) &&
           device_clock_stop(&s->clock, 1, "the trace stage", err) &&
           device_clock_add(&s->clock, 0, &s->spent.trace);
}

bool start(cuda_state *s, const photon_job *job, trace_job *out,
           brume_error *err)
{
    out->scene = s->job.scene;
    out->photons = *job;
    out->photons.source = s->source;
    /* Its field may have been laid out anew. */
    photons_lone(&s->frame.flat->view, job->seed, job->frame, &s->lone);
    out->lone = s->lone;
    out->list[0] = s->list[0];
    out->list[1] = s->list[1];
    out->room = list_room(s);
    out->queue = s->queue;
    out->turn = 0;
    out->processors = s->processors;
    out->rings = s->rings;
    out->sum = s->sum;
    out->total = s->total;
    size_t bytes = static_cast<size_t>(job->sources) * sizeof *s->source;
    return device_check(cudaMemcpy(s->source, job->source, bytes,
                                   cudaMemcpyHostToDevice),
                        "uploading the sources", err) &&
           device_check(cudaMemset(s->queue, 0, sizeof *s->queue),
                        "clearing the counters", err) &&
           device_check(cudaMemset(s->total, 0, sizeof *s->total),
                        "clearing the counters", err);
}

/* The first channel's sums are those of the others. */
__global__ void share_colors(radiance_lattice f, int64_t *sum, uint64_t cells)
{
    uint64_t i = static_cast<uint64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i >= cells)
        return;
    int64_t *at = sum + i * static_cast<uint64_t>(f.numbers);
    for (int k = 0; f.eye >= 0 && k < f.phases; k++)
        at[f.eye + 3 * k + 1] = at[f.eye + 3 * k + 2] = at[f.eye + 3 * k];
    if (f.fluence >= 0)
        at[f.fluence + 1] = at[f.fluence + 2] = at[f.fluence];
    for (int k = 0; f.flux >= 0 && k < 3; k++)
        at[f.flux + 3 + k] = at[f.flux + 6 + k] = at[f.flux + k];
}

void end_trace(cuda_state *s)
{
    const flat_scene *view = &s->frame.flat->view;
    if (!s->one_color || view->radiance_count == 0)
        return;
    uint64_t cells = view->radiance_count /
                     static_cast<uint64_t>(view->field.numbers);
    share_colors<<<static_cast<unsigned>((cells + block_size - 1) / block_size),
                   block_size>>>(view->field, s->sum, cells);
}

/* As radiance_resolve. */
__global__ void resolve(const int64_t *sum, float *cells, uint64_t count,
                        double scale)
{
    uint64_t i = static_cast<uint64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < count)
        cells[i] = static_cast<float>(static_cast<double>(sum[i]) * scale);
}

/* A block of cells a thread. */
__global__ void halve(radiance_lattice field, const int64_t *sum, float *blocks,
                      uint64_t count, double scale)
{
    uint64_t i = static_cast<uint64_t>(blockIdx.x) * blockDim.x + threadIdx.x;
    if (i < count)
        blocks[i] = half_block(&field, sum, i, scale);
}

cell_job describe_cells(const cuda_state *s)
{
    return {s->job.scene, s->job.pixels.seed, s->job.pixels.frame, s->cells,
            s->cell_list, s->cell_queue,      s->processors};
}

/* A brick a block, a cell a thread. */
__global__ void sharpen(const __grid_constant__ flat_scene scene,
                        const float *means, float *cells)
{
    if (scene.radiance_slots[blockIdx.x] >= 0)
        radiance_sharpen(&scene, means, blockIdx.x,
                         static_cast<int>(threadIdx.x), cells);
}

}

size_t photons_bytes(const cuda_state *s)
{
    const backend_frame *frame = &s->frame;
    if (!frame->stages->photons)
        return 0;
    return device_round(radiance_sum_bytes(frame->flat)) +
           device_round(most_sources(frame) * sizeof(photon_source)) +
           device_round(sizeof(photon_totals)) + 2 * list_bytes(s) +
           device_round(sizeof(photon_queue)) + ring_bytes(s) +
           device_round(sizeof(cell_queue)) +
           device_round(cell_list_bytes(frame));
}

bool photons_open(cuda_state *s, brume_error *err)
{
    if (!s->frame.stages->photons)
        return true;
    size_t bytes = radiance_sum_bytes(s->frame.flat);
    device_arena *a = &s->arena;
    s->sum = static_cast<int64_t *>(device_take(a, bytes));
    s->source = static_cast<photon_source *>(
        device_take(a, most_sources(&s->frame) * sizeof *s->source));
    s->total = static_cast<photon_totals *>(device_take(a, sizeof *s->total));
    s->list[0] = device_take(a, list_bytes(s));
    s->list[1] = device_take(a, list_bytes(s));
    s->queue = static_cast<photon_queue *>(device_take(a, sizeof *s->queue));
    s->rings = device_take(a, ring_bytes(s));
    s->cell_queue = static_cast<cell_queue *>(
        device_take(a, sizeof *s->cell_queue));
    s->cell_list = static_cast<uint64_t *>(
        device_take(a, cell_list_bytes(&s->frame)));
    return device_check(cudaMemset(s->sum, 0, bytes), "clearing the field",
                        err);
}

/* Launches without work, of what the frame's stages will launch: the first one
 * of a kernel waits until its code and its threads' stacks have their place. */
bool photons_warm(cuda_state *s, brume_error *err)
{
    const radiance_lattice *f = &s->frame.flat->view.field;
    photon_job none = {};
    trace_job t;
    if (!s->frame.stages->photons)
        return true;
    if (!start(s, &none, &t, err))
        return false;
    t.first = 0;
    t.born = 0;
    t.last = 1;
    s->births->bear(&t);
    if (!device_check(s->tracer->trace(&t, 1, s->trace_threads),
                      "launching the trace stage", err))
        return false;
    cell_job cells = describe_cells(s);
    cells.scene.radiance_slots_count = 0;
    resolve<<<1, block_size>>>(s->sum, s->cells, 0, 0.0);
    cudaMemsetAsync(s->cell_queue, 0, sizeof *s->cell_queue);
    if (f->ball)
        s->photons->balls(&cells);
    if (f->single || f->lit)
        s->photons->light(&cells);
    return device_wait("opening", err);
}

bool cuda_trace(void *state, const photon_job *job, brume_stats *stats,
                brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    trace_job t;
    if (!start(s, job, &t, err))
        return false;
    uint64_t most = born_at_once(&s->frame);
    for (t.first = 0; t.first < job->count; t.first += t.born) {
        uint64_t left = job->count - t.first;
        t.born = static_cast<unsigned>(left < most ? left : most);
        t.last = left == t.born;
        if (!launch(s, &t, err))
            return false;
        t.turn = !t.turn;
        double done = static_cast<double>(t.first + t.born);
        if (!s->frame.tick(s->frame.user,
                           done / static_cast<double>(job->count)))
            return true;
    }
    end_trace(s);
    return read_totals(s, stats, err);
}

/* The means stand where the sums were that they are of. */
static void sharpen_cells(cuda_state *s, uint64_t count)
{
    float *means = reinterpret_cast<float *>(s->sum);
    unsigned bricks = static_cast<unsigned>(
        s->frame.flat->view.radiance_slots_count);
    cudaMemcpyAsync(means, s->cells, count * sizeof *s->cells,
                    cudaMemcpyDeviceToDevice);
    sharpen<<<bricks, 512>>>(s->job.scene, means, s->cells);
}

bool cuda_gather(void *state, double unit, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const radiance_lattice *f = &s->frame.flat->view.field;
    uint64_t count = s->frame.flat->view.radiance_count;
    uint64_t blocks = (count + block_size - 1) / block_size;
    cell_job job = describe_cells(s);
    if (count == 0)
        return true;
    device_clock_mark(&s->clock, 0);
    if (unit > 0.0)
        resolve<<<static_cast<unsigned>(blocks), block_size>>>(
            s->sum, s->cells, count, radiance_scale(f, unit));
    if (backend_sharpens(&s->frame))
        sharpen_cells(s, count);
    if (unit > 0.0 && f->ball) {
        cudaMemsetAsync(s->cell_queue, 0, sizeof *s->cell_queue);
        s->photons->balls(&job);
    }
    if (f->single || f->lit) {
        cudaMemsetAsync(s->cell_queue, 0, sizeof *s->cell_queue);
        s->photons->light(&job);
    }
    return device_check(cudaGetLastError(), "launching the gather stage",
                        err) &&
           device_clock_stop(&s->clock, 1, "the gather stage", err) &&
           device_clock_add(&s->clock, 0, &s->spent.gather);
}

/* By way of the field, which is yet to be made. */
bool cuda_halve(void *state, double unit, float *blocks, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const radiance_lattice *f = &s->frame.flat->view.field;
    uint64_t count = radiance_blocks(s->frame.flat);
    if (count == 0)
        return true;
    halve<<<static_cast<unsigned>((count + block_size - 1) / block_size),
            block_size>>>(*f, s->sum, s->cells, count, radiance_scale(f, unit));
    return device_check(cudaGetLastError(), "launching the gather stage",
                        err) &&
           device_check(cudaMemcpy(blocks, s->cells, count * sizeof *blocks,
                                   cudaMemcpyDeviceToHost),
                        "reading the field", err);
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
    return upload_put(&s->to, s->arena.base, s->cells, cells, bytes, err) &&
           upload_flush(&s->to, err);
}

/* Room for fields that grow from pass to pass: a quarter more than is needed,
 * so that few of them ask for more. */
static bool make_room(device_arena *arena, size_t bytes, brume_error *err)
{
    if (arena->base && arena->size >= bytes) {
        arena->used = 0;
        return true;
    }
    device_arena_free(arena);
    return device_arena_new(arena, bytes + bytes / 4, err);
}

bool cuda_renew(void *state, brume_error *err)
{
    cuda_state *s = static_cast<cuda_state *>(state);
    const flat_scene *from = &s->frame.flat->view;
    flat_scene *to = &s->job.scene;
    size_t slots = from->radiance_slots_count * sizeof *from->radiance_slots;
    size_t cells = from->radiance_count * sizeof *from->radiance;
    size_t sums = radiance_sum_bytes(s->frame.flat);
    size_t list = cell_list_bytes(&s->frame);
    if (!make_room(&s->field,
                   device_round(slots) + device_round(cells) +
                       device_round(sums) + device_round(list),
                   err))
        return false;
    to->field = from->field;
    to->radiance_count = from->radiance_count;
    to->radiance_slots_count = from->radiance_slots_count;
    void *at = device_take(&s->field, slots);
    to->radiance_slots = static_cast<int32_t *>(at);
    s->cells = static_cast<float *>(device_take(&s->field, cells));
    to->radiance = s->cells;
    s->sum = static_cast<int64_t *>(device_take(&s->field, sums));
    s->cell_list = static_cast<uint64_t *>(device_take(&s->field, list));
    return device_check(cudaMemcpy(at, from->radiance_slots, slots,
                                   cudaMemcpyHostToDevice),
                        "uploading the field", err) &&
           device_check(cudaMemset(s->sum, 0, sums), "clearing the field", err);
}
