/* shoot_kernel.cuh - a ray a thread. SHOOT_KERNEL names what is defined here:
 * once with the short stack of the kd-tree in each thread's own memory, once in
 * the block's. */
#define HD_INLINE __forceinline__
#define SCENE_MAY (MAY_MESHES | MAY_SURFACES | MAY_KDTREE)
#define KD_THREADS 128
#include "tests/gpu/shoot.h"

void shoot_own(const flat_scene *s, const bvh_ray *ray, uint32_t rays,
               ray_hit *hit);
void shoot_shared(const flat_scene *s, const bvh_ray *ray, uint32_t rays,
                  ray_hit *hit);

namespace
{

__global__ void __launch_bounds__(KD_THREADS)
find_hits(const __grid_constant__ flat_scene s, const bvh_ray *ray,
          uint32_t rays, ray_hit *hit)
{
    uint32_t i = blockIdx.x * KD_THREADS + threadIdx.x;
    ray_hit after = hit_start(0.0f);
    if (i < rays)
        hit[i] = bvh_nearest(&s, &ray[i], &after, INFINITY);
}

}

void SHOOT_KERNEL(const flat_scene *s, const bvh_ray *ray, uint32_t rays,
                  ray_hit *hit)
{
    find_hits<<<(rays + KD_THREADS - 1) / KD_THREADS, KD_THREADS>>>(*s, ray,
                                                                    rays, hit);
}
