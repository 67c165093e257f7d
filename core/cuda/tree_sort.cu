/* Sorting and sums of trees' builders, by CUB. */
#include "core/cuda/tree.cuh"
#define CCCL_DISABLE_NVTX
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>

static const int code_bits = 63;

size_t tree_sort_bytes(uint32_t count)
{
    size_t sort = 0, sum = 0;
    uint64_t *none = nullptr;
    cub::DoubleBuffer<uint64_t> code(none, none);
    cub::DoubleBuffer<uint32_t> order(nullptr, nullptr);
    cub::DeviceRadixSort::SortPairs(nullptr, sort, code, order, count, 0,
                                    code_bits);
    cub::DeviceScan::ExclusiveSum(nullptr, sum, none, none, count);
    return sort > sum ? sort : sum;
}

cudaError_t tree_sort(uint64_t *code[2], uint32_t *order[2], uint32_t count,
                      void *scratch, size_t bytes)
{
    cub::DoubleBuffer<uint64_t> codes(code[0], code[1]);
    cub::DoubleBuffer<uint32_t> orders(order[0], order[1]);
    cudaError_t code_of = cub::DeviceRadixSort::SortPairs(
        scratch, bytes, codes, orders, count, 0, code_bits);
    code[0] = codes.Current();
    code[1] = codes.Alternate();
    order[0] = orders.Current();
    order[1] = orders.Alternate();
    return code_of;
}

cudaError_t tree_sum(const uint64_t *from, uint64_t *to, uint32_t count,
                     void *scratch, size_t bytes)
{
    return cub::DeviceScan::ExclusiveSum(scratch, bytes, from, to, count);
}
