/* A part is bytes that are neighbours on the device, which go there in one
 * copy; the first are small, for the device to begin early. Threads fill parts
 * piece by piece. One alone talks to the driver: each that does waits 0.1 ms
 * the first time, and for the others. */
#include "core/cuda/upload.cuh"
#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sched.h>
#ifdef __SSE2__
#include <emmintrin.h>
#endif
extern "C" {
#include "lib/memory.h"
#include "lib/thread.h"
}

namespace
{

const size_t part_size = 2u << 20, first_size = 256u << 10;
const size_t piece_size = 64u << 10;
const int most_threads = 12;

/* Shorter gaps of an allocation are sent along. */
const ptrdiff_t most_gap = 256;

struct part {
    const void *whole; /* no copy goes beyond one allocation         */
    char *to;
    size_t bytes;
    size_t item;              /* the first that it has bytes of            */
    size_t piece, pieces;     /* the number of its first                   */
    std::atomic<size_t> left; /* pieces that are not filled yet            */
};

struct sending {
    uploader *to;
    part *list;
    size_t count, pieces;
    std::atomic<size_t> next; /* the piece that nobody has taken yet       */
    std::atomic<size_t> gone; /* parts that the device has read            */
    std::atomic<int> code;    /* the first error                           */
};

char *memory_of(const uploader *u, size_t part)
{
    return u->memory + part % UPLOAD_PARTS * part_size;
}

cudaEvent_t event_of(const uploader *u, size_t part)
{
    return u->gone[part % UPLOAD_PARTS];
}

/* ---- parts -------------------------------------------------------------- */

size_t limit_of(size_t part)
{
    return std::min(first_size << std::min(part, size_t{8}), part_size);
}

/* Whether bytes of an item for that place can follow those of the n-th part. */
bool follows(const part *p, size_t n, const upload_item *item, const char *to)
{
    return p->whole == item->whole && to - (p->to + p->bytes) < most_gap &&
           to - p->to < static_cast<ptrdiff_t>(limit_of(n));
}

/* As many parts as there can be. */
size_t most_parts(const upload_list *put)
{
    size_t count = 0;
    for (size_t i = 0; i < put->count; i++)
        count += 2 + put->item[i].bytes / first_size;
    return count;
}

/* Bytes that a part takes of an item, from that one on. */
size_t take_bytes(part *p, size_t n, const upload_item *item, size_t at)
{
    size_t before = static_cast<size_t>(item->to + at - p->to);
    size_t bytes = std::min(item->bytes - at, limit_of(n) - before);
    p->bytes = before + bytes;
    return bytes;
}

void count_pieces(sending *s)
{
    for (size_t i = 0; i < s->count; i++) {
        part *p = &s->list[i];
        p->piece = s->pieces;
        p->pieces = (p->bytes + piece_size - 1) / piece_size;
        p->left = p->pieces;
        s->pieces += p->pieces;
    }
}

void lay_out(sending *s, const upload_list *put)
{
    for (size_t i = 0; i < put->count; i++) {
        const upload_item *item = &put->item[i];
        for (size_t at = 0; at < item->bytes;) {
            part *last = s->list + s->count - 1;
            if (s->count == 0 ||
                !follows(last, s->count - 1, item, item->to + at)) {
                last = s->list + s->count++;
                last->whole = item->whole;
                last->to = item->to + at;
                last->item = i;
            }
            at += take_bytes(last, s->count - 1, item, at);
        }
    }
    count_pieces(s);
}

/* ---- filling ------------------------------------------------------------ */

enum class found { piece, none_yet, none };

/* The next piece, if its part's memory is free. */
found take_piece(sending *s, size_t *number, size_t *of)
{
    size_t i = s->next.load();
    do {
        size_t gone = s->gone.load(), p = gone;
        if (i >= s->pieces || s->code.load() != cudaSuccess)
            return found::none;
        while (i >= s->list[p].piece + s->list[p].pieces)
            p++;
        if (p >= gone + UPLOAD_PARTS)
            return found::none_yet;
        *of = p;
    } while (!s->next.compare_exchange_weak(i, i + 1));
    *number = i;
    return found::piece;
}

#ifdef __SSE2__
/* As memcpy, past the caches: what still lies in those of another core the
 * device reads at a third of its rate. */
void stream(char *to, const char *from, size_t bytes)
{
    size_t step = sizeof(__m128i);
    size_t first = std::min(-reinterpret_cast<uintptr_t>(to) % step, bytes);
    size_t end = bytes - (bytes - first) % step;
    memcpy(to, from, first);
    for (size_t i = first; i < end; i += step)
        _mm_stream_si128(
            reinterpret_cast<__m128i *>(to + i),
            _mm_loadu_si128(reinterpret_cast<const __m128i *>(from + i)));
    memcpy(to + end, from + end, bytes - end);
    _mm_sfence();
}
#else
void stream(char *to, const char *from, size_t bytes)
{
    memcpy(to, from, bytes);
}
#endif

/* The bytes of a part from one to another. */
void copy_bytes(const sending *s, const part *p, char *memory, size_t from,
                size_t end)
{
    const char *first = p->to + from, *last = p->to + end;
    const upload_list *put = &s->to->put;
    for (size_t i = p->item; i < put->count && put->item[i].to < last; i++) {
        const upload_item *it = &put->item[i];
        const char *a = std::max<const char *>(it->to, first);
        const char *b = std::min<const char *>(it->to + it->bytes, last);
        if (a < b)
            stream(memory + (a - p->to), it->from + (a - it->to),
                   static_cast<size_t>(b - a));
    }
}

found fill_piece(sending *s)
{
    size_t number, of;
    found what = take_piece(s, &number, &of);
    if (what != found::piece)
        return what;
    part *p = &s->list[of];
    size_t from = (number - p->piece) * piece_size;
    copy_bytes(s, p, memory_of(s->to, of), from,
               std::min(from + piece_size, p->bytes));
    p->left--;
    return what;
}

void fill(sending *s)
{
    for (found what; (what = fill_piece(s)) != found::none;)
        if (what == found::none_yet)
            sched_yield();
}

/* ---- sending ------------------------------------------------------------ */

cudaError_t send_part(const sending *s, size_t i)
{
    const part *p = &s->list[i];
    cudaError_t code = cudaMemcpyAsync(p->to, memory_of(s->to, i), p->bytes,
                                       cudaMemcpyHostToDevice);
    return code != cudaSuccess ? code : cudaEventRecord(event_of(s->to, i));
}

/* Sees what has been read, of so many parts that were sent. */
cudaError_t look(sending *s, size_t sent)
{
    cudaError_t code = cudaSuccess;
    while (s->gone < sent && code == cudaSuccess) {
        code = cudaEventQuery(event_of(s->to, s->gone));
        if (code == cudaSuccess)
            s->gone++;
    }
    return code == cudaErrorNotReady ? cudaSuccess : code;
}

/* Sends what is filled, and fills meanwhile. */
void send(sending *s)
{
    cudaError_t code = cudaSetDevice(s->to->device);
    for (size_t sent = 0; sent < s->count && code == cudaSuccess;) {
        if (s->list[sent].left == 0) {
            code = send_part(s, sent++);
            continue;
        }
        code = look(s, sent);
        if (code == cudaSuccess && fill_piece(s) != found::piece)
            sched_yield();
    }
    s->code = code;
}

/* The first that there is sends, so that none waits for a thread that may not
 * come. */
void take_role(void *context, size_t index, int thread)
{
    (void)thread;
    sending *s = static_cast<sending *>(context);
    if (index == 0)
        send(s);
    else
        fill(s);
}

/* What another flush sent has been read. */
cudaError_t wait(const uploader *u)
{
    cudaError_t code = cudaSuccess;
    for (int i = 0; i < UPLOAD_PARTS && code == cudaSuccess; i++)
        code = cudaEventSynchronize(u->gone[i]);
    return code;
}

bool send_put(uploader *u, brume_error *err)
{
    upload_item *item = u->put.item;
    std::sort(
        item, item + u->put.count,
        [](const upload_item &a, const upload_item &b) { return a.to < b.to; });
    sending s = {};
    s.to = u;
    s.list = static_cast<part *>(
        memory_new(most_parts(&u->put), sizeof *s.list, err));
    if (!s.list)
        return false;
    lay_out(&s, &u->put);
    s.code = wait(u);
    if (s.code == cudaSuccess)
        parallel_for(u->threads,
                     std::min(s.pieces, static_cast<size_t>(u->threads)),
                     take_role, &s, nullptr);
    free(s.list);
    return device_check(static_cast<cudaError_t>(s.code.load()),
                        "uploading the scene", err);
}

bool send_moved(const uploader *u, brume_error *err)
{
    cudaError_t code = cudaSuccess;
    for (size_t i = 0; i < u->moved.count && code == cudaSuccess; i++) {
        const upload_item *it = &u->moved.item[i];
        code = cudaMemcpyAsync(it->to, it->from, it->bytes,
                               cudaMemcpyDeviceToDevice);
    }
    return device_check(code, "uploading the scene", err);
}

bool add(upload_list *list, const void *whole, void *to, const void *from,
         size_t bytes, brume_error *err)
{
    void *grown = memory_grow(list->item, &list->room, list->count + 1,
                              sizeof *list->item, err);
    if (!grown)
        return false;
    list->item = static_cast<upload_item *>(grown);
    list->item[list->count++] = {whole, static_cast<char *>(to),
                                 static_cast<const char *>(from), bytes};
    return true;
}

}

bool upload_new(uploader *u, int threads, std::atomic<char *> *spare,
                brume_error *err)
{
    *u = {};
    u->threads = std::min(threads > 0 ? threads : thread_processors(),
                          most_threads);
    u->spare = spare;
    void *memory = spare ? spare->exchange(nullptr) : nullptr;
    bool kept = memory != nullptr;
    if (!device_check(cudaGetDevice(&u->device), "opening", err) ||
        (!memory &&
         !device_check(cudaHostAlloc(&memory, UPLOAD_PARTS * part_size,
                                     cudaHostAllocPortable),
                       "opening", err)))
        return false;
    u->memory = static_cast<char *>(memory);
    u->set_aside = kept ? 0 : UPLOAD_PARTS * part_size;
    for (int i = 0; i < UPLOAD_PARTS; i++)
        if (!device_check(
                cudaEventCreateWithFlags(&u->gone[i], cudaEventDisableTiming),
                "opening", err))
            return false;
    return true;
}

void upload_free(uploader *u)
{
    for (int i = 0; i < UPLOAD_PARTS; i++)
        if (u->gone[i]) {
            cudaEventSynchronize(u->gone[i]);
            cudaEventDestroy(u->gone[i]);
        }
    char *old = u->memory;
    if (old && u->spare)
        old = u->spare->exchange(old);
    if (old)
        cudaFreeHost(old);
    free(u->put.item);
    free(u->moved.item);
    *u = {};
}

bool upload_put(uploader *u, const void *whole, void *to, const void *from,
                size_t bytes, brume_error *err)
{
    return bytes == 0 || add(&u->put, whole, to, from, bytes, err);
}

bool upload_move(uploader *u, const void *whole, void *to, const void *from,
                 size_t bytes, brume_error *err)
{
    return bytes == 0 || add(&u->moved, whole, to, from, bytes, err);
}

bool upload_flush(uploader *u, brume_error *err)
{
    bool good = (u->put.count == 0 || send_put(u, err)) && send_moved(u, err);
    u->put.count = u->moved.count = 0;
    return good;
}

/* ---- bringing ----------------------------------------------------------- */

namespace
{

struct bringing {
    uploader *to;
    const char *from;
    size_t bytes, part; /* of each but the last                    */
};

size_t bytes_of(const bringing *b, size_t i)
{
    return std::min(b->part, b->bytes - i * b->part);
}

cudaError_t bring_part(const bringing *b, size_t i)
{
    cudaError_t code = cudaMemcpyAsync(memory_of(b->to, i),
                                       b->from + i * b->part, bytes_of(b, i),
                                       cudaMemcpyDeviceToHost);
    return code != cudaSuccess ? code : cudaEventRecord(event_of(b->to, i));
}

}

/* A part is taken while others are on their way. */
bool upload_bring(uploader *u, const void *from, size_t bytes, size_t item,
                  upload_taker *take, void *user, brume_error *err)
{
    bringing b = {u, static_cast<const char *>(from), bytes,
                  part_size / item * item};
    size_t parts = (bytes + b.part - 1) / b.part, asked = 0;
    cudaError_t code = wait(u);
    for (size_t i = 0; i < parts && code == cudaSuccess; i++) {
        for (; asked < std::min(i + UPLOAD_PARTS, parts) && code == cudaSuccess;
             asked++)
            code = bring_part(&b, asked);
        if (code == cudaSuccess)
            code = cudaEventSynchronize(event_of(u, i));
        if (code == cudaSuccess)
            take(user, i * b.part, memory_of(u, i), bytes_of(&b, i));
    }
    return device_check(code, "bringing the picture", err);
}
