// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/libraries.hpp"

#include <gdcmTrace.h>
#include <itkMultiThreaderBase.h>
#include <itkObject.h>
#include <omp.h>
#include <vtkObject.h>

namespace brainshift::pipelines {

void set_threads(int threads) {
  const auto count = static_cast<itk::ThreadIdType>(threads);
  omp_set_num_threads(threads);
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(count);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(count);
}

int threads_in_use() {
  return omp_get_max_threads();
}

void silence_libraries() {
  itk::Object::SetGlobalWarningDisplay(false);
  vtkObject::SetGlobalWarningDisplay(0);
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

}  // namespace brainshift::pipelines
