// SPDX-License-Identifier: GPL-3.0-or-later
#include <cooperative_groups.h>

#include <algorithm>

#include "solve/device/backend.hpp"
#include "solve/device/cuda_check.hpp"
#include "solve/device/each/cuda_each.hpp"
#include "solve/device/each/tasks.hpp"

namespace brainshift::solve::device {

namespace {

constexpr int threads = most_members * groups_of_block;
constexpr int combined_at_once = 4;

__device__ double (*numbers_of_groups())[groups_of_block][most_members] {
  __shared__ double of_group[combined_at_once][groups_of_block][most_members];
  return of_group;
}

/// All threads of the device: a warp is a group, a lane a member.
struct WarpsForEach {
  static constexpr int own = 1;

  __device__ static int lane() { return static_cast<int>(threadIdx.x) % most_members; }
  __device__ int group() const { return static_cast<int>(threadIdx.x) / most_members; }
  __device__ int groups() const { return groups_of_block; }
  __device__ int block() const { return static_cast<int>(blockIdx.x); }
  __device__ int blocks() const { return static_cast<int>(gridDim.x); }
  __device__ bool leads() const { return lane() == 0; }
  __device__ void sync_all() const { cooperative_groups::this_grid().sync(); }

  template <class Use>
  __device__ void for_each(Members who, const Use& use) const {
    if ((who >> lane() & 1) != 0) {
      use(lane());
    }
  }
  template <class Use>
  __device__ Members which(Members who, const Use& use) const {
    bool is_so = false;
    if ((who >> lane() & 1) != 0) {
      is_so = use(lane());
    }
    return __ballot_sync(0xffffffffU, is_so);
  }
  template <int sums, int count, class Use>
  __device__ void combine(const double (&of)[count][own], const Use& use) const {
    double(*const of_group)[groups_of_block][most_members] = numbers_of_groups();
    for (int first = 0; first < count; first += combined_at_once) {
      __syncthreads();  // what was there has been read
      BRAINSHIFT_UNROLLED
      for (int k = 0; k < count; ++k) {  // of[k] stays in a register
        if (k >= first && k < first + combined_at_once) {
          of_group[k - first][group()][lane()] = of[k][0];
        }
      }
      __syncthreads();
      for (int k = first + group(); k < std::min(count, first + combined_at_once); k += groups()) {
        double all = of_group[k - first][0][lane()];
        for (int g = 1; g < groups_of_block; ++g) {
          const double x = of_group[k - first][g][lane()];
          all = k < sums ? all + x : larger(all, x);
        }
        use(k, lane(), all);
      }
    }
  }
};

template <TaskOfEach task, class Scalar>
__global__ void __launch_bounds__(threads, 1)
    kernel_of_each(const __grid_constant__ ViewOfEach<Scalar> view, const __grid_constant__ OrderOfEach order) {
  perform<task>(WarpsForEach{}, view, order);
}

template <class Scalar>
void launch(TaskOfEach task, const ViewOfEach<Scalar>& view, const OrderOfEach& order) {
  with_task(task, [&]<TaskOfEach which>() {
    const void* arguments[] = {&view, &order};
    check(cudaLaunchCooperativeKernel(reinterpret_cast<const void*>(kernel_of_each<which, Scalar>),
                                      dim3(static_cast<unsigned>(gpu()->blocks)), dim3(threads),
                                      const_cast<void**>(arguments), 0, nullptr),
          "begin a step of many loads");
  });
}

}  // namespace

void perform_each_on_gpu(TaskOfEach task, const ViewOfEach<float>& view, const OrderOfEach& order) {
  launch(task, view, order);
}
void perform_each_on_gpu(TaskOfEach task, const ViewOfEach<double>& view, const OrderOfEach& order) {
  launch(task, view, order);
}

}  // namespace brainshift::solve::device
