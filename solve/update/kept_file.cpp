// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <span>
#include <stdexcept>

#include "segmentation/files/not_written.hpp"
#include "solve/body/lay_out.hpp"
#include "solve/update/archive.hpp"
#include "solve/update/kept_run.hpp"
#include "solve/update/mapped_file.hpp"

namespace brainshift::solve {
namespace fs = std::filesystem;

namespace {

constexpr std::string_view format = "brainshift kept run 9\n";
constexpr std::size_t head_size = 256;

/// Tells damage; eight bytes at a time, every fourth in a sum of its own, which do not wait for each other.
std::uint64_t checksum(std::span<const char> bytes) {
  constexpr std::size_t lanes = 4;
  std::array<std::uint64_t, lanes> word{}, sum{bytes.size(), 1, 2, 3};
  for (std::size_t i = 0; i < bytes.size(); i += sizeof word) {
    word = {};
    std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
    for (std::size_t k = 0; k < lanes; ++k) {
      sum[k] = (sum[k] ^ word[k]) * 0x9e3779b97f4a7c15U;
      sum[k] ^= sum[k] >> 32;
    }
  }
  return sum[0] ^ std::rotl(sum[1], 16) ^ std::rotl(sum[2], 32) ^ std::rotl(sum[3], 48);
}

/// Before the payload: what it is, of what, and the size and checksum of what follows. Filled up with spaces to where a
/// number may lie.
std::string head_of(const std::string& key, std::span<const char> payload) {
  std::string head = std::string(format) + key + "\n" + std::to_string(payload.size()) + " " +
                     std::to_string(checksum(payload)) + "\n";
  head.resize(head_size, ' ');
  return head;
}

template <class Archive, class Rows>
void rows(Archive& archive, Rows& rows) {
  archive.many(rows.begin);
  archive.many(rows.node);
  archive.many(rows.value);
  archive.many(rows.derivative);
}

/// By their members: between them there may be bytes that nobody has set.
void divisions(ArchiveWriter& writer, const PointBlocks& points) {
  std::vector<std::int64_t> flat;
  for (const Block& b : points.blocks) {
    flat.insert(flat.end(), {b.first_patch, b.last_patch, b.first_slot, b.slots});
  }
  writer.many(flat);
  flat.clear();
  for (const Patch& p : points.patches) {
    flat.insert(flat.end(), {p.first_point, p.last_point, p.material, p.first_slot});
  }
  writer.many(flat);
}

void divisions(ArchiveReader& reader, PointBlocks& points) {
  const auto whole = [](std::int64_t number) { return static_cast<std::int32_t>(number); };
  std::vector<std::int64_t> flat;
  reader.many(flat);
  for (std::size_t i = 0; i + 3 < flat.size(); i += 4) {
    points.blocks.push_back({whole(flat[i]), whole(flat[i + 1]), flat[i + 2], whole(flat[i + 3])});
  }
  reader.many(flat);
  for (std::size_t i = 0; i + 3 < flat.size(); i += 4) {
    points.patches.push_back({whole(flat[i]), whole(flat[i + 1]), whole(flat[i + 2]), flat[i + 3]});
  }
}

/// The nodes of each part, after how many there are.
void stiff_parts(ArchiveWriter& writer, const Body& body) {
  std::vector<std::int32_t> flat;
  for (const std::vector<std::int32_t>& part : body.stiff_parts) {
    flat.push_back(static_cast<std::int32_t>(part.size()));
    flat.insert(flat.end(), part.begin(), part.end());
  }
  writer.many(flat);
}

void stiff_parts(ArchiveReader& reader, Body& body) {
  std::vector<std::int32_t> flat;
  reader.many(flat);
  for (auto next = flat.begin(); next < flat.end();) {
    const std::ptrdiff_t count = std::min<std::ptrdiff_t>(*next++, flat.end() - next);
    body.stiff_parts.emplace_back(next, next + count);
    next += count;
  }
}

void thinned(ArchiveWriter& writer, const std::optional<ThinnedBody>& kept) {
  writer.plain(static_cast<std::uint8_t>(kept.has_value()));
  if (kept) {
    writer.many(kept->node);
    writer.points(kept->stiff.cloud.positions);
    writer.many(kept->stiff.cloud.spacing);
    writer.many(kept->stiff.cloud.on_surface);
    writer.matrix(kept->stiff.stiffness);
    writer.plain(static_cast<std::uint8_t>(kept->stiff.touches));
  }
}

void thinned(ArchiveReader& reader, std::optional<ThinnedBody>& kept) {
  std::uint8_t there = 0, touches = 0;
  reader.plain(there);
  if (there != 0) {
    ThinnedBody& body = kept.emplace();
    reader.many(body.node);
    reader.points(body.stiff.cloud.positions);
    reader.many(body.stiff.cloud.spacing);
    reader.many(body.stiff.cloud.on_surface);
    reader.matrix(body.stiff.stiffness);
    reader.plain(touches);
    body.stiff.touches = touches != 0;
  }
}

template <class Archive, class Blocks>
void blocks(Archive& archive, Blocks& points) {
  divisions(archive, points);
  archive.many(points.volume);
  archive.many(points.mode);
  archive.many(points.pair_begin);
  archive.many(points.support);
  archive.many(points.pair_slot);
  archive.many(points.pair_derivative);
  archive.many(points.pair_single);
  archive.many(points.slot_node);
  archive.many(points.node_begin);
  archive.many(points.node_slot);
  archive.many(points.felt);
}

/// But laws, conditions, contact and forces.
template <class Archive, class Kept>
void kept_body(Archive& archive, Kept& kept) {
  archive.many(kept.body.original);
  archive.points(kept.body.positions);
  archive.many(kept.body.spacing);
  rows(archive, kept.body.nodal_rows);
  blocks(archive, kept.body.points);
  archive.points(kept.body.placed.position);
  archive.many(kept.body.placed.tissue);
  stiff_parts(archive, kept.body);
  archive.many(kept.body.node_modulus);
  archive.many(kept.parameters);
  archive.many(kept.settled.mass);
  archive.plain(kept.settled.mass_scale);
  archive.plain(kept.settled.lowest);
  archive.plain(kept.settled.smallest_jacobian);
}

template <class Archive, class Run>
void kept_run(Archive& archive, Run& run) {
  archive.many(run.on_surface);
  archive.points(run.prescribed);
  archive.points(run.displacement);
  kept_body(archive, run.fine);
  archive.plain(run.trusted);
  archive.many(run.responses.nodes);
  archive.many(run.responses.waves);
  archive.many(run.responses.parameters);
  thinned(archive, run.thinned);
}

void write_forces(ArchiveWriter& writer, const Body& body) {
  writer.many(body.external.empty() ? NodalVectors() : body.external.full());
}

void read_forces(ArchiveReader& reader, Body& body) {
  NodalVectors full;
  reader.many(full);
  body.external = ExternalForce(std::move(full));
}

void write_skull(ArchiveWriter& writer, const std::optional<Contact>& contact) {
  writer.plain(static_cast<std::uint8_t>(contact.has_value()));
  if (contact) {
    const SignedDistance::Samples& samples = contact->skull()->samples();
    writer.plain(samples.spacing);
    writer.plain(samples.horizon);
    for (int axis = 0; axis < 3; ++axis) {
      writer.plain(samples.origin[axis]);
      writer.plain(samples.size[axis]);
    }
    writer.many(samples.value);
  }
}

std::shared_ptr<const SignedDistance> read_skull(ArchiveReader& reader) {
  std::uint8_t there = 0;
  reader.plain(there);
  if (there == 0) {
    return nullptr;
  }
  SignedDistance::Samples samples;
  reader.plain(samples.spacing);
  reader.plain(samples.horizon);
  for (int axis = 0; axis < 3; ++axis) {
    reader.plain(samples.origin[axis]);
    reader.plain(samples.size[axis]);
  }
  reader.many(samples.value);
  return std::make_shared<const SignedDistance>(std::move(samples));
}

/// The next load says which nodes may touch the skull.
void add_what_is_not_kept(KeptBody& kept, const std::map<std::int32_t, Material>& materials,
                          const std::shared_ptr<const SignedDistance>& skull) {
  kept.body.laws = laws_with(kept.body, materials);
  if (skull) {
    kept.body.contact.emplace(skull, Points(0, 3), std::span<const std::int32_t>(), ShapeRows());
  }
}

/// All of the file but its head; nothing where it is another's or damaged.
std::span<const char> payload_of(std::span<const char> bytes, const std::string& key) {
  if (bytes.size() <= head_size) {
    return {};
  }
  const std::span<const char> payload = bytes.subspan(head_size);
  return std::string_view(bytes.data(), head_size) == head_of(key, payload) ? payload : std::span<const char>();
}

}  // namespace

void write_kept(const fs::path& file, const KeptRun& kept, const std::string& key) {
  std::vector<char> bytes;
  ArchiveWriter writer(bytes);
  kept_run(writer, kept);
  write_forces(writer, kept.fine.body);
  write_skull(writer, kept.fine.body.contact);
  fs::path unfinished = file;
  unfinished += ".partial";
  std::ofstream stream(unfinished, std::ios::binary);
  stream << head_of(key, bytes);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  std::error_code fault;
  if (stream) {
    fs::rename(unfinished, file, fault);
  }
  if (!stream || fault) {
    fs::remove(unfinished, fault);
    fail_to_write(file);
  }
}

std::optional<KeptRun> read_kept(const fs::path& file, const std::string& key,
                                 const std::map<std::int32_t, Material>& materials, const SolveOptions& options) {
  const MappedFile mapped(file);
  const std::span<const char> payload = payload_of(mapped.bytes(), key);
  if (payload.empty()) {
    return std::nullopt;
  }
  try {
    ArchiveReader reader(payload);
    KeptRun run;
    kept_run(reader, run);
    run.origin = {run.fine.parameters, run.prescribed, run.displacement, run.fine.settled.lowest};
    run.prepared_for = run.prescribed;
    run.options = options;
    run.options.precision = run.fine.body.points.precision();
    read_forces(reader, run.fine.body);
    add_what_is_not_kept(run.fine, materials, read_skull(reader));
    return reader.at_end() ? std::optional(std::move(run)) : std::nullopt;
  } catch (const std::length_error&) {
    return std::nullopt;
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

}  // namespace brainshift::solve
