// SPDX-License-Identifier: GPL-3.0-or-later
#include "segmentation/image/gzip_file.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "segmentation/files/not_written.hpp"
#include "segmentation/files/refuse.hpp"

namespace brainshift {
namespace {

constexpr std::size_t block_size = std::size_t{1} << 20;
constexpr int level = 1;  // images of floats: a few per cent larger than at level 3, twice as fast

using GzipBytes = std::vector<std::uint8_t>;

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

[[noreturn]] void refuse_damaged(const std::filesystem::path& file) {
  refuse(file, "the compressed data are cut short or damaged; copy the file again");
}

// At most so many bytes; at the end of the stream its checksum is looked at.
GzipBytes read_gzip(const std::filesystem::path& file, gzFile stream, std::size_t at_most) {
  GzipBytes bytes;
  bytes.reserve(at_most);
  int count = 0;
  do {
    const std::size_t size = bytes.size();
    bytes.resize(std::min(at_most, size + block_size));
    count = gzread(stream, bytes.data() + size, static_cast<unsigned>(bytes.size() - size));
    bytes.resize(size + static_cast<std::size_t>(std::max(0, count)));
  } while (count > 0 && bytes.size() < at_most);
  int status = Z_OK;
  gzerror(stream, &status);
  if (status == Z_MEM_ERROR) {
    throw std::bad_alloc();
  }
  if (count < 0 || status != Z_OK) {
    refuse_damaged(file);
  }
  return bytes;
}

// Of zlib or gzip, as the stream's first bytes say.
struct Inflation {
  z_stream stream{};

  Inflation() {
    constexpr int either = 32 + 15;
    if (inflateInit2(&stream, either) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~Inflation() { inflateEnd(&stream); }
  Inflation(const Inflation&) = delete;
  Inflation& operator=(const Inflation&) = delete;
};

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
  bool whole = true, memory = true;
#pragma omp parallel for schedule(dynamic) reduction(&& : whole, memory)
  for (std::size_t i = 0; i < count; ++i) {
    try {
      const GzipBytes block = read_block(plain, i * block_size, size_of(i));
      blocks[i] = {deflate_block(block, i + 1 == count), crc32_z(0, block.data(), block.size())};
      whole = whole && block.size() == size_of(i) && !blocks[i].deflated.empty();
    } catch (const std::bad_alloc&) {
      memory = false;
    }
  }
  if (!memory) {
    throw std::bad_alloc();
  }

  std::ofstream out(file, std::ios::binary);
  const bool ours = out.is_open();
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
    if (ours) {
      std::filesystem::remove(file, ignored);
    }
    fail_to_write(file);
  }
}

bool is_gzip(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in.get() == 0x1f && in.get() == 0x8b;
}

std::vector<std::uint8_t> first_uncompressed(const std::filesystem::path& file, std::size_t count) {
  const GzipFile stream = open_gzip(file);
  return read_gzip(file, stream.get(), count);
}

std::vector<std::uint8_t> uncompressed(const std::filesystem::path& file, std::size_t at_most) {
  const GzipFile stream = open_gzip(file);
  gzbuffer(stream.get(), static_cast<unsigned>(block_size));
  std::vector<std::uint8_t> bytes = read_gzip(file, stream.get(), at_most + 1);
  if (bytes.size() > at_most) {
    refuse(file, "goes on behind the voxels that its header promises, so one of them is damaged; copy the file again");
  }
  return bytes;
}

void check_inflates(const std::filesystem::path& file, std::uint64_t offset, std::uint64_t bytes) {
  Inflation inflation;
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(offset));
  GzipBytes packed(block_size), plain(block_size);
  z_stream& stream = inflation.stream;
  std::uint64_t found = 0;
  while (found <= bytes) {
    if (stream.avail_in == 0) {
      in.read(reinterpret_cast<char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
      stream.next_in = packed.data();
      stream.avail_in = static_cast<uInt>(in.gcount());
    }
    stream.next_out = plain.data();
    stream.avail_out = static_cast<uInt>(plain.size());
    const int status = stream.avail_in > 0 ? inflate(&stream, Z_NO_FLUSH) : Z_BUF_ERROR;
    found += plain.size() - stream.avail_out;
    if (status == Z_STREAM_END && found == bytes) {
      return;
    }
    if (status != Z_OK && (status != Z_STREAM_END || inflateReset(&stream) != Z_OK)) {
      break;
    }
  }
  refuse_damaged(file);
}

}  // namespace brainshift
