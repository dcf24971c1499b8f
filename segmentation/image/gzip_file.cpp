// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/gzip_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

namespace brainshift {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 20;
constexpr int level = 1;  // images of floats: a few per cent larger than at level 3, twice as fast

struct CloseGzip {
  void operator()(gzFile file) const { gzclose(file); }
};
using GzipFile = std::unique_ptr<gzFile_s, CloseGzip>;

GzipFile open_gzip(const std::filesystem::path& file) {
  GzipFile stream(gzopen(file.c_str(), "rb"));
  if (!stream) {
    throw std::invalid_argument(file.string() + ": cannot be opened for reading");
  }
  return stream;
}

using GzipBytes = std::vector<std::uint8_t>;

GzipBytes read_block(const std::filesystem::path& file, std::size_t begin, std::size_t size) {
  GzipBytes block(size);
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(begin));
  in.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(size));
  block.resize(static_cast<std::size_t>(in.gcount()));
  return block;
}

// One block as raw deflate that ends on a byte boundary, so that blocks can be joined; empty when zlib fails.
GzipBytes deflate_block(const GzipBytes& block, bool last) {
  z_stream stream{};
  constexpr int raw_deflate = -15;
  if (deflateInit2(&stream, level, Z_DEFLATED, raw_deflate, 9, Z_DEFAULT_STRATEGY) != Z_OK) {
    return {};
  }
  constexpr uLong flush_marker = 16;
  GzipBytes result(deflateBound(&stream, static_cast<uLong>(block.size())) + flush_marker);
  stream.next_in = const_cast<Bytef*>(block.data());
  stream.avail_in = static_cast<uInt>(block.size());
  stream.next_out = result.data();
  stream.avail_out = static_cast<uInt>(result.size());
  const int status = deflate(&stream, last ? Z_FINISH : Z_SYNC_FLUSH);
  result.resize(status == (last ? Z_STREAM_END : Z_OK) ? stream.total_out : 0);
  result.shrink_to_fit();
  deflateEnd(&stream);
  return result;
}

struct DeflatedBlock {
  GzipBytes deflated;
  uLong checksum = 0;  // of the plain bytes
};

void put_little_endian(std::ostream& out, std::uint32_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.put(static_cast<char>((value >> shift) & 0xffU));
  }
}

void put_bytes(std::ostream& out, std::span<const std::uint8_t> bytes) {
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace

void write_gzip(const std::filesystem::path& file, const std::filesystem::path& plain) {
  const std::size_t size = std::filesystem::file_size(plain);
  const std::size_t count = std::max<std::size_t>(1, (size + block_size - 1) / block_size);
  std::vector<DeflatedBlock> blocks(count);
  const auto size_of = [&](std::size_t i) { return std::min(block_size, size - i * block_size); };
  bool whole = true;
#pragma omp parallel for schedule(dynamic) reduction(&& : whole)
  for (std::size_t i = 0; i < count; ++i) {
    const GzipBytes block = read_block(plain, i * block_size, size_of(i));
    blocks[i] = {deflate_block(block, i + 1 == count), crc32_z(0, block.data(), block.size())};
    whole = whole && block.size() == size_of(i) && !blocks[i].deflated.empty();
  }

  std::ofstream out(file, std::ios::binary);
  constexpr std::array<std::uint8_t, 10> header = {0x1f, 0x8b, Z_DEFLATED, 0, 0, 0, 0, 0, 0, 0xff};
  put_bytes(out, header);
  uLong checksum = crc32_z(0, nullptr, 0);
  for (std::size_t i = 0; i < count; ++i) {
    put_bytes(out, blocks[i].deflated);
    checksum = crc32_combine(checksum, blocks[i].checksum, static_cast<z_off_t>(size_of(i)));
  }
  put_little_endian(out, static_cast<std::uint32_t>(checksum));
  put_little_endian(out, static_cast<std::uint32_t>(size));
  out.close();
  if (!out || !whole) {
    std::error_code ignored;
    std::filesystem::remove(file, ignored);
    throw std::runtime_error(file.string() + ": could not be written whole; is the disk full or the folder read-only?");
  }
}

std::vector<std::uint8_t> uncompressed(const std::filesystem::path& file) {
  const GzipFile stream = open_gzip(file);
  gzbuffer(stream.get(), static_cast<unsigned>(block_size));
  std::vector<std::uint8_t> bytes(std::filesystem::file_size(file) + block_size);
  std::size_t size = 0;
  int count = 0;
  while ((count = gzread(stream.get(), bytes.data() + size, static_cast<unsigned>(block_size))) > 0) {
    size += static_cast<std::size_t>(count);
    if (bytes.size() < size + block_size) {
      bytes.resize(2 * bytes.size());
    }
  }
  int status = Z_OK;
  gzerror(stream.get(), &status);
  if (count < 0 || status != Z_OK) {
    throw std::invalid_argument(file.string() + ": the compressed data are cut short or damaged; copy the file again");
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace brainshift
