// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/phantom/phantom.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace {

struct PhantomArguments {
  PhantomOptions options;
  std::filesystem::path out;
};

}  // namespace

void add_phantom_command(CLI::App& program, const Settings& settings) {
  CLI::App* command = program.add_subcommand("phantom", "A synthetic head with known answers and its scene.");
  auto arguments = std::make_shared<PhantomArguments>();
  command->add_option("--size", arguments->options.size, "voxels along each axis")->capture_default_str();
  command->add_option("--spacing", arguments->options.spacing, "of the voxels, mm")->capture_default_str();
  command->add_option("--seed", arguments->options.seed, "of the texture")->capture_default_str();
  command->add_option("--out", arguments->out, "folder for the head")->required()->type_name("DIR");
  command->callback([arguments, &settings] {
    StageFolder folder(arguments->out, *settings.interruption);
    write_phantom(arguments->options, folder.path());
    folder.merge();
  });
}

}  // namespace brainshift::pipelines
