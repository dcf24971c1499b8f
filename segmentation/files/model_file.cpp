// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/files/model_file.hpp"

#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkOutputWindow.h>
#include <vtkPolyDataReader.h>
#include <vtkPolyDataWriter.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLPolyDataReader.h>

#include <cmath>
#include <fstream>
#include <string>

#include "segmentation/files/legacy_vtk_claims.hpp"
#include "segmentation/files/lower_case.hpp"
#include "segmentation/files/not_written.hpp"
#include "segmentation/files/readable_file.hpp"
#include "segmentation/files/refuse.hpp"
#include "segmentation/files/vtk_cells.hpp"
#include "segmentation/files/vtk_claims.hpp"
#include "segmentation/files/vtk_faults.hpp"
#include "segmentation/files/vtu_file.hpp"
#include "segmentation/files/write_text.hpp"

namespace brainshift {
namespace {

namespace fs = std::filesystem;

/// Takes what VTK would show, and counts it.
class CountingWindow : public vtkOutputWindow {
 public:
  static CountingWindow* New() { return new CountingWindow; }
  void DisplayText(const char*) override { ++said_; }
  int said() const { return said_; }

 private:
  int said_ = 0;
};

/// While it lives, VTK's complaints are counted and not shown, those without an object too: of a legacy file cut short
/// its readers tell in no other way, and not at all where warnings are switched off.
class Complaints {
 public:
  Complaints() {
    vtkOutputWindow::SetInstance(window_);
    vtkObject::GlobalWarningDisplayOn();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  ~Complaints() {
    vtkLogger::SetStderrVerbosity(verbosity_);
    vtkObject::SetGlobalWarningDisplay(display_);
    vtkOutputWindow::SetInstance(before_);
  }
  Complaints(const Complaints&) = delete;
  Complaints& operator=(const Complaints&) = delete;

  bool any() const { return window_->said() > 0; }

 private:
  vtkNew<CountingWindow> window_;
  vtkSmartPointer<vtkOutputWindow> before_ = vtkOutputWindow::GetInstance();
  int display_ = vtkObject::GetGlobalWarningDisplay();
  vtkLogger::Verbosity verbosity_ = vtkLogger::GetCurrentVerbosityCutoff();
};

/// The first bytes of a file: a header in text.
std::string beginning_of(const fs::path& file) {
  constexpr std::size_t header_length = 65536;  // its comments may be many
  std::string header(header_length, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(header.data(), static_cast<std::streamsize>(header.size()));
  header.resize(static_cast<std::size_t>(in.gcount()));
  return header;
}

/// "5.1" of "# vtk DataFile Version 5.1".
double legacy_version(const fs::path& file) {
  const std::string begin = "# vtk DataFile Version ", header = beginning_of(file);
  return header.starts_with(begin) ? std::strtod(header.c_str() + begin.size(), nullptr) : 0;
}

template <class Reader>
vtkSmartPointer<vtkPointSet> read_legacy_as(const fs::path& file) {
  const Complaints complaints;
  vtkNew<Reader> reader;
  reader->ReadAllScalarsOn();
  reader->ReadAllVectorsOn();
  reader->ReadAllNormalsOn();
  reader->ReadAllTensorsOn();
  reader->ReadAllColorScalarsOn();
  reader->ReadAllTCoordsOn();
  reader->ReadAllFieldsOn();
  reader->SetFileName(file.c_str());
  reader->Update();
  if (complaints.any() || reader->GetErrorCode() != 0) {
    refuse(file, "is damaged or truncated; copy it again");
  }
  check_cells(file, *reader->GetOutput());
  return reader->GetOutput();
}

constexpr double new_cells_since = 5;  // the version in which cells became offsets and corners

vtkSmartPointer<vtkPointSet> read_legacy(const fs::path& file) {
  if (legacy_version(file) < new_cells_since) {
    check_legacy_vtk_claims(file);
  }
  vtkNew<vtkPolyDataReader> kind;
  kind->SetFileName(file.c_str());
  if (legacy_version(file) > 0 && kind->IsFilePolyData() != 0) {
    return read_legacy_as<vtkPolyDataReader>(file);
  }
  if (legacy_version(file) > 0 && kind->IsFileUnstructuredGrid() != 0) {
    return read_legacy_as<vtkUnstructuredGridReader>(file);
  }
  refuse(file, "is no legacy .vtk file of a surface, lines, points or an unstructured grid; save it as .vtp or .vtu");
}

template <class Writer>
void write_legacy_as(const fs::path& file, vtkPointSet& model, const fs::path& as_in) {
  vtkNew<vtkPolyDataReader> kind;
  kind->SetFileName(as_in.c_str());
  kind->OpenVTKFile();
  kind->ReadHeader();
  // A program that wrote the old form may not read the new one.
  vtkNew<Writer> writer;
  writer->SetInputData(&model);
  writer->SetFileType(kind->GetFileType());
  writer->SetHeader(kind->GetHeader());
  kind->CloseVTKFile();
  writer->SetFileVersion(legacy_version(as_in) < new_cells_since ? vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2
                                                                 : vtkDataWriter::VTK_LEGACY_READER_VERSION_5_1);
  writer->WriteToOutputStringOn();
  if (writer->Write() != 1) {
    fail_to_write(file);
  }
  write_text(file, std::string(writer->GetOutputString(), static_cast<std::size_t>(writer->GetOutputStringLength())));
}

void check_points(const fs::path& file, vtkPointSet& model) {
  if (model.GetNumberOfPoints() == 0) {
    refuse(file, "holds no point");
  }
  for (vtkIdType p = 0; p < model.GetNumberOfPoints(); ++p) {
    const double* const x = model.GetPoint(p);
    if (!std::isfinite(x[0]) || !std::isfinite(x[1]) || !std::isfinite(x[2])) {
      refuse(file, "point " + std::to_string(p + 1) + " of " + std::to_string(model.GetNumberOfPoints()) +
                       " is not finite; repair the file");
    }
  }
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_vtp(const fs::path& file) {
  check_vtk_claims(file);
  const FaultListener faults;
  vtkNew<vtkXMLPolyDataReader> reader;
  faults.listen_to(*reader);
  reader->SetFileName(file.c_str());
  const bool readable = reader->CanReadFile(file.c_str()) != 0;
  if (readable) {
    reader->Update();
  }
  if (!readable || faults.failed() || reader->GetErrorCode() != 0) {
    refuse(file, "is no .vtp surface, or is damaged or truncated; copy it again");
  }
  vtkSmartPointer<vtkPolyData> data = reader->GetOutput();
  check_cells(file, *data);
  return data;
}

vtkSmartPointer<vtkPointSet> read_model(const fs::path& file) {
  check_readable(file);
  const std::string ending = ending_of(file);
  vtkSmartPointer<vtkPointSet> model;
  if (ending == ".vtp") {
    model = read_vtp(file);
  } else if (ending == ".vtu") {
    model = vtu::read(file);
  } else if (ending == ".vtk") {
    model = read_legacy(file);
  } else {
    refuse(file, "models with arrays end in .vtp, .vtu or .vtk");
  }
  check_points(file, *model);
  return model;
}

void write_model(const fs::path& file, vtkPointSet& model, const fs::path& as_in) {
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(&model);
  if (ending_of(file) == ".vtk") {
    grid == nullptr ? write_legacy_as<vtkPolyDataWriter>(file, model, as_in)
                    : write_legacy_as<vtkUnstructuredGridWriter>(file, model, as_in);
  } else if (grid != nullptr) {
    vtu::write(file, *grid);
  } else {
    vtu::write(file, *vtkPolyData::SafeDownCast(&model));
  }
}

Frame frame_of_model(const fs::path& file, vtkDataObject& model) {
  if (auto* space = vtkStringArray::SafeDownCast(model.GetFieldData()->GetAbstractArray("SPACE"))) {
    return space->GetNumberOfValues() > 0 && space->GetValue(0) == "RAS" ? Frame::ras : Frame::lps;
  }
  return frame_in_header(file);
}

Frame frame_in_header(const fs::path& file) {
  return beginning_of(file).find("SPACE=RAS") != std::string::npos ? Frame::ras : Frame::lps;
}

}  // namespace brainshift
