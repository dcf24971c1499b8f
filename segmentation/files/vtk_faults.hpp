// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Bridge to VTK, for .cpp files. Not a public header.

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkNew.h>
#include <vtkXMLReader.h>

namespace brainshift {

/// Hears errors and warnings of a reader of VTK's XML instead of the terminal.
class FaultListener {
 public:
  FaultListener() {
    observer_->SetCallback([](vtkObject*, unsigned long, void* failed, void*) { *static_cast<bool*>(failed) = true; });
    observer_->SetClientData(&failed_);
  }
  void listen_to(vtkXMLReader& reader) const {
    for (vtkObject* said_by : {static_cast<vtkObject*>(&reader), static_cast<vtkObject*>(reader.GetExecutive())}) {
      said_by->AddObserver(vtkCommand::ErrorEvent, observer_);
      said_by->AddObserver(vtkCommand::WarningEvent, observer_);
    }
    reader.SetReaderErrorObserver(observer_);
    reader.SetParserErrorObserver(observer_);
  }
  bool failed() const { return failed_; }

 private:
  bool failed_ = false;
  vtkNew<vtkCallbackCommand> observer_;
};

}  // namespace brainshift
