// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/checksum/sha256.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace brainshift::pipelines {
namespace {

/// Of data that comes in pieces.
class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    check(context_ != nullptr && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
  }

  void add(std::string_view data) { check(EVP_DigestUpdate(context_.get(), data.data(), data.size()) == 1); }

  /// Call it once.
  std::string hex() {
    std::array<unsigned char, 32> digest;
    check(EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr) == 1);
    std::string text;
    for (const unsigned char byte : digest) {
      text += {"0123456789abcdef"[byte >> 4], "0123456789abcdef"[byte & 15]};
    }
    return text;
  }

 private:
  static void check(bool succeeded) {
    if (!succeeded) {
      throw std::runtime_error("OpenSSL does not compute SHA-256 here");
    }
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

void add_file(Sha256& hash, const std::filesystem::path& file) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) {  // a pipe or a device may never end
    throw std::invalid_argument(file.string() + ": cannot be read; check that it exists and is a regular file");
  }
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> piece(1 << 20);
  while (stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    hash.add({piece.data(), static_cast<std::size_t>(stream.gcount())});
  }
  if (!stream.eof()) {
    throw std::invalid_argument(file.string() + ": cannot be read; check that it exists and that you may read it");
  }
}

}  // namespace

std::string sha256_of_text(std::string_view text) {
  Sha256 hash;
  hash.add(text);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  Sha256 hash;
  std::error_code unknown;
  if (!std::filesystem::is_directory(file, unknown)) {
    add_file(hash, file);
    return hash.hex();
  }
  std::vector<std::filesystem::path> files;
  std::filesystem::directory_iterator entry(file, unknown);
  for (; !unknown && entry != std::filesystem::directory_iterator(); entry.increment(unknown)) {
    std::error_code ignored;
    if (entry->is_regular_file(ignored)) {
      files.push_back(entry->path());
    }
  }
  if (unknown) {
    throw std::invalid_argument(file.string() + ": this folder cannot be read (" + unknown.message() +
                                "); check its permissions");
  }
  std::sort(files.begin(), files.end());
  std::string listing;
  for (const auto& one : files) {
    listing += one.filename().string() + " " + sha256_of_file(one) + "\n";
  }
  return sha256_of_text(listing);
}

}  // namespace brainshift::pipelines
