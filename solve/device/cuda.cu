// SPDX-License-Identifier: GPL-3.0-or-later
#include <cooperative_groups.h>

#include <algorithm>

#include "solve/device/backend.hpp"
#include "solve/device/cuda_check.hpp"

namespace brainshift::solve::device {

namespace {

constexpr int threads = 512;
constexpr int most_sums = 64;

__device__ double (*sums_of_warps())[most_sums] {
  __shared__ double of_warp[threads / 32][most_sums];
  return of_warp;
}

/// All threads of the device.
struct AllThreads {
  static constexpr int lanes = 4, half = 16, wide = 32;
  template <class Scalar>
  static constexpr int at_once = sizeof(Scalar) == sizeof(float) ? 12 : 4;

  __device__ int thread() const { return static_cast<int>(threadIdx.x); }
  __device__ int threads() const { return static_cast<int>(blockDim.x); }
  __device__ int block() const { return static_cast<int>(blockIdx.x); }
  __device__ int blocks() const { return static_cast<int>(gridDim.x); }
  __device__ std::byte* room() const {
    extern __shared__ __align__(32) std::byte memory[];
    return memory;
  }
  __device__ void sync_block() const { __syncthreads(); }
  __device__ void sync_all() const { cooperative_groups::this_grid().sync(); }

  /// Of the lanes that share a point, those that are next to each other.
  template <int width>
  __device__ static unsigned mask() {
    return width == 32 ? 0xffffffffu : ((1u << width) - 1u) << (threadIdx.x % 32 / width * width);
  }
  template <int width, class Number>
  __device__ Number sum(Number x) const {
    for (int i = 1; i < width; i *= 2) {
      x += __shfl_xor_sync(mask<width>(), x, i, width);
    }
    return x;
  }
  template <int width>
  __device__ double largest(double x) const {
    for (int i = 1; i < width; i *= 2) {
      x = larger(x, __shfl_xor_sync(mask<width>(), x, i, width));
    }
    return x;
  }
  __device__ void add(std::int32_t* to, std::int32_t more) const { atomicAdd(to, more); }
  __device__ void add(std::int64_t* to, std::int64_t more) const {
    atomicAdd(reinterpret_cast<unsigned long long*>(to), static_cast<unsigned long long>(more));
  }
  __device__ void raise(std::uint64_t* to, std::uint64_t key) const {
    atomicMax(reinterpret_cast<unsigned long long*>(to), static_cast<unsigned long long>(key));
  }
  template <int sums, int count>
  __device__ void combine(const double (&of_thread)[count], double* of_block) const {
    static_assert(count <= most_sums);
    double(*const of_warp)[most_sums] = sums_of_warps();
    __syncthreads();
    for (int k = 0; k < count; ++k) {
      const double x = k < sums ? sum<32>(of_thread[k]) : largest<32>(of_thread[k]);
      if (thread() % 32 == 0) {
        of_warp[thread() / 32][k] = x;
      }
    }
    __syncthreads();
    if (thread() < count) {
      double all = of_warp[0][thread()];
      for (int w = 1; w < device::threads / 32; ++w) {
        all = thread() < sums ? all + of_warp[w][thread()] : larger(all, of_warp[w][thread()]);
      }
      of_block[thread()] = all;
    }
  }
};

template <Task task, class Scalar>
__global__ void __launch_bounds__(threads, 1)
    kernel(const __grid_constant__ View<Scalar> view, const __grid_constant__ Order order) {
  perform<task>(AllThreads{}, view, order);
}

template <Task task, class Scalar>
void launch(const View<Scalar>& view, const Order& order) {
  const std::size_t room = std::max(Room<Scalar>::size(view), room_to_sweep);
  const auto function = reinterpret_cast<const void*>(kernel<task, Scalar>);
  check(cudaFuncSetAttribute(function, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(room)),
        "set its memory apart");
  const void* arguments[] = {&view, &order};
  check(cudaLaunchCooperativeKernel(function, dim3(static_cast<unsigned>(gpu()->blocks)), dim3(threads),
                                    const_cast<void**>(arguments), room, nullptr),
        "begin a step");
}

template <class Scalar>
void perform_on_gpu(Task task, const View<Scalar>& view, const Order& order) {
  with_task(task, [&]<Task which>() { launch<which>(view, order); });
}

void* allocate(std::size_t bytes) {
  void* memory = nullptr;
  check(cudaMalloc(&memory, bytes), "set memory apart");
  return memory;
}

/// As a sentence; empty: the first GPU can be used, and has these properties.
std::string why_not_usable(cudaDeviceProp& properties) {
  int devices = 0;
  cudaError_t error = cudaGetDeviceCount(&devices);
  if (error == cudaSuccess) {
    error = devices == 0 ? cudaErrorNoDevice : cudaGetDeviceProperties(&properties, 0);
  }
  if (error != cudaSuccess) {
    return std::string("there is no GPU that CUDA can use: ") + cudaGetErrorString(error);
  }
  const std::string name = properties.name;
  cudaFuncAttributes attributes{};
  error = cudaFuncGetAttributes(&attributes, reinterpret_cast<const void*>(kernel<Task::step, float>));
  if (properties.cooperativeLaunch == 0 || error == cudaErrorNoKernelImageForDevice ||
      error == cudaErrorInvalidDeviceFunction) {
    return "this program was not built for the GPU " + name + " (BRAINSHIFT_CUDA_ARCHITECTURES)";
  }
  return error == cudaSuccess ? "" : "the GPU " + name + " cannot be used: " + cudaGetErrorString(error);
}

/// What there is, and why not, once and for all.
struct Found {
  std::string why_not;
  Backend backend;

  Found() {
    cudaDeviceProp properties{};
    why_not = why_not_usable(properties);
    if (!why_not.empty()) {
      cudaGetLastError();
      return;
    }
    backend = {
        .blocks = properties.multiProcessorCount,
        .room = properties.sharedMemPerBlockOptin - (std::size_t{10} << 10),  // that of combine()
        .allocate = allocate,
        .release = [](void* memory) { cudaFree(memory); },
        .clear = [](void* memory, std::size_t bytes) { check(cudaMemset(memory, 0, bytes), "clear its memory"); },
        .to_device = [](void* to, const void* from,
                        std::size_t bytes) { check(cudaMemcpy(to, from, bytes, cudaMemcpyDefault), "take data"); },
        .from_device = [](void* to, const void* from,
                          std::size_t bytes) { check(cudaMemcpy(to, from, bytes, cudaMemcpyDefault), "compute"); },
        .copy = [](void* to, const void* from,
                   std::size_t bytes) { check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice), "copy"); },
        .single = perform_on_gpu<float>,
        .twofold = perform_on_gpu<double>};
  }
};

const Found& found() {
  static const Found what;
  return what;
}

}  // namespace

const Backend* gpu() {
  return found().why_not.empty() ? &found().backend : nullptr;
}

std::string why_no_gpu() {
  return found().why_not;
}

}  // namespace brainshift::solve::device
