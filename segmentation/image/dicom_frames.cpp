// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/dicom_frames.hpp"

#include <gdcmSequenceOfItems.h>

#include "segmentation/files/refuse.hpp"
#include "segmentation/image/gdcm_bridge.hpp"

namespace brainshift {
namespace {

using gdcm::DataSet;
using gdcm::Tag;

using Items = gdcm::SmartPointer<gdcm::SequenceOfItems>;

const Tag shared_groups(0x5200, 0x9229), groups_of_frames(0x5200, 0x9230);

Items items_of(const DataSet& groups, const Tag& sequence) {
  return groups.FindDataElement(sequence) ? groups.GetDataElement(sequence).GetValueAsSQ() : Items();
}

const DataSet& item(const Items& items, std::size_t index) {
  return items->GetItem(index + 1).GetNestedDataSet();  // GDCM counts from 1
}

/// What a frame is told in its own groups, else in those of all.
class GroupsOfFrame {
 public:
  GroupsOfFrame(const DataSet& own, const Items& shared) : own_(own), shared_(shared) {}

  /// Empty where neither tells it.
  std::vector<double> numbers(const Tag& sequence, const Tag& tag) const {
    std::vector<double> found = numbers_in(own_, sequence, tag);
    if (found.empty() && shared_ && shared_->GetNumberOfItems() > 0) {
      found = numbers_in(item(shared_, 0), sequence, tag);
    }
    return found;
  }

 private:
  static std::vector<double> numbers_in(const DataSet& groups, const Tag& sequence, const Tag& tag) {
    const Items items = items_of(groups, sequence);
    return items && items->GetNumberOfItems() > 0 ? dicom_numbers(dicom::text_of(item(items, 0), tag))
                                                  : std::vector<double>();
  }

  const DataSet& own_;
  const Items& shared_;
};

DicomSlice frame_of(const DicomSlice& whole, std::size_t frame, const GroupsOfFrame& groups) {
  DicomSlice slice = whole;
  slice.frames = 1;
  slice.frame = frame + 1;
  slice.position = groups.numbers({0x0020, 0x9113}, {0x0020, 0x0032});
  slice.orientation = groups.numbers({0x0020, 0x9116}, {0x0020, 0x0037});
  slice.spacing = groups.numbers({0x0028, 0x9110}, {0x0028, 0x0030});
  slice.rescale = groups.numbers({0x0028, 0x9145}, {0x0028, 0x1053});
  const std::vector<double> intercept = groups.numbers({0x0028, 0x9145}, {0x0028, 0x1052});
  slice.rescale.insert(slice.rescale.end(), intercept.begin(), intercept.end());
  return slice;
}

}  // namespace

DicomSlice with_place(const DicomSlice& slice) {
  if (slice.frames != 1 || slice.is_placed()) {
    return slice;
  }
  DicomSlice placed = frames_of(slice).front();
  placed.frame = 0;
  placed.rescale.clear();  // a library reads that of each file
  return placed;
}

std::vector<DicomSlice> frames_of(const DicomSlice& whole) {
  const gdcm::File file = dicom::read_header(whole.file);
  const DataSet& header = file.GetDataSet();
  const Items shared = items_of(header, shared_groups), each = items_of(header, groups_of_frames);
  if (!each || each->GetNumberOfItems() != whole.frames) {
    refuse(whole.file, "holds " + std::to_string(whole.frames) +
                           " frames, but does not tell the place of each (PerFrameFunctionalGroupsSequence); "
                           "convert the series to .nii.gz");
  }
  std::vector<DicomSlice> frames;
  for (std::size_t frame = 0; frame < whole.frames; ++frame) {
    const DicomSlice slice = frame_of(whole, frame, {item(each, frame), shared});
    if (!slice.is_placed()) {
      refuse(whole.file, "frame " + std::to_string(slice.frame) +
                             " has no position, orientation or spacing that can be used; convert the series to "
                             ".nii.gz");
    }
    frames.push_back(slice);
  }
  return frames;
}

}  // namespace brainshift
