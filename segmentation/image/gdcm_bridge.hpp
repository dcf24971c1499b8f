// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: the elements of a DICOM header, read and written with GDCM.

#include <gdcmDataSet.h>
#include <gdcmFile.h>

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>

namespace brainshift::dicom {

inline const gdcm::Tag pixel_data(0x7fe0, 0x0010);

/// The header of a file: all before its pixels, each element with its value representation. Throws
/// std::invalid_argument, naming the file.
gdcm::File read_header(const std::filesystem::path& file);

/// An element's text without the blanks and zeros that fill it up; empty where there is none.
std::string text_of(const gdcm::DataSet& header, const gdcm::Tag& tag);

/// Puts an element of the standard in, over the one that is there: with the value representation that the dictionary
/// has, filled up to an even number of bytes.
void set(gdcm::DataSet& header, const gdcm::Tag& tag, std::string value);
void set_if_absent(gdcm::DataSet& header, const gdcm::Tag& tag, const std::string& value);
void set_number(gdcm::DataSet& header, const gdcm::Tag& tag, std::uint16_t value);

/// Numbers as decimal strings, which have at most 16 characters, with backslashes between.
std::string decimal(double value);
/// The number that decimal() writes.
double rounded_to_decimal(double value);
std::string decimals(std::initializer_list<double> values);

/// A UID made of a name: a UUID of version 5 as a number behind 2.25 (DICOM PS3.5, B.2). Equal names give equal UIDs.
std::string uid_of(const std::string& name);

}  // namespace brainshift::dicom
