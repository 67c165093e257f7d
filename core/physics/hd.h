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

#ifdef __CUDACC__
#define HD static inline __host__ __device__
#else
#define HD static inline
#endif

/* Tables live in the constant memory of a device, in read-only data of a
 * host: HD_TABLE(float, name, 3) = { ... }; */
#ifdef __CUDACC__
#define HD_TABLE(type, name, count) static __device__ const type name[count]
#else
#define HD_TABLE(type, name, count) static const type name[count]
#endif

#endif
