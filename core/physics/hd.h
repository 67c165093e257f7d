/* hd.h - how one source of physics serves the CPU and CUDA.
 *
 * Every header in core/physics/ is plain data and HD functions in the common
 * subset of C11 and C++17: no recursion, no function pointers, no statics, no
 * allocation, floats with an f suffix. `make lint` compiles each header alone
 * as both; nvcc compiles them too where it is installed. */
#ifndef CORE_PHYSICS_HD_H
#define CORE_PHYSICS_HD_H
#include <stdbool.h>
#include <stdint.h>

/* HD_INLINE may be __forceinline__: a state that no call is given a pointer
 * to stays in registers. */
#ifndef HD_INLINE
#define HD_INLINE inline
#endif
#ifdef __CUDACC__
#define HD static HD_INLINE __device__
#else
#define HD static inline
#endif

/* A function that stays one: called seldom, and large. */
#ifdef __CUDACC__
#define HD_APART static __noinline__ __device__
#else
#define HD_APART static __attribute__((noinline, unused))
#endif

/* One that is called at many places: there is one of it on a GPU, whose store
 * of instructions is small. */
#ifdef __CUDACC__
#define HD_SHARED static __noinline__ __device__
#else
#define HD_SHARED static inline
#endif

/* On a GPU, what such a function is given a pointer to lies in memory for good:
 * so it is given copies, and what it made of them is taken back. */
#ifdef __CUDACC__
#define HD_COPY(type, p) type p##_copy = *(p)
#define HD_COPIED(p) (&p##_copy)
#define HD_RETURN(p) (*(p) = p##_copy)
#else
#define HD_COPY(type, p) ((void)0)
#define HD_COPIED(p) (p)
#define HD_RETURN(p) ((void)0)
#endif

/* A loop that a GPU's code has once, however often it goes round. */
#ifdef __CUDACC__
#define HD_ROLLED _Pragma("unroll 1")
#else
#define HD_ROLLED
#endif

/* Of an address that is a multiple of n bytes. */
#define HD_ALIGNED(n) __attribute__((aligned(n)))

/* Like fminf and fmaxf, which are calls on a plain x86-64, but for NaN: the
 * second argument is returned if either is NaN. */
HD float hd_min(float a, float b)
{
    return a < b ? a : b;
}

HD float hd_max(float a, float b)
{
    return a > b ? a : b;
}

/* hd_min of a bound that is neither NaN nor a zero, hd_max of one that is
 * neither NaN nor -0: a GPU has an instruction for each. */
HD float hd_at_most(float x, float bound)
{
#ifdef __CUDA_ARCH__
    return fminf(x, bound);
#else
    return hd_min(x, bound);
#endif
}

HD float hd_at_least(float x, float bound)
{
#ifdef __CUDA_ARCH__
    return fmaxf(x, bound);
#else
    return hd_max(x, bound);
#endif
}

/* Floor to int; what lies beyond 2^30 is taken as there. */
HD int hd_floor(float x)
{
    int i = (int)hd_max(hd_min(x, 1073741824.0f), -1073741824.0f);
    return i - (x < (float)i);
}

/* Tables live in the constant memory of a device, in read-only data of a
 * host: HD_TABLE(float, name, 3) = { ... }; */
#ifdef __CUDACC__
#define HD_TABLE(type, name, count) static __device__ const type name[count]
#else
#define HD_TABLE(type, name, count) static const type name[count]
#endif

#endif
