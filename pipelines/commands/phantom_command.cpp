// SPDX-License-Identifier: GPL-3.0-or-later
#include <memory>

#include "pipelines/commands/commands.hpp"
#include "pipelines/commands/table_option.hpp"
#include "pipelines/phantom/cylinder.hpp"
#include "pipelines/phantom/phantom.hpp"
#include "pipelines/runner/stage_folder.hpp"

namespace brainshift::pipelines {
namespace {

struct PhantomArguments {
  PhantomOptions options;
  std::string shape = "head";
  std::filesystem::path out;
};

}  // namespace

void add_phantom_command(CLI::App& program, const Settings& settings) {
  CLI::App* command =
      program.add_subcommand("phantom", "A synthetic head with known answers, or a cylinder, and its scene.");
  auto arguments = std::make_shared<PhantomArguments>();
  command
      ->add_option("--shape", arguments->shape, "a head, or a soft cylinder pressed on a plate, which takes no option")
      ->check(CLI::IsMember({"head", "cylinder"}))
      ->type_name("head | cylinder")
      ->capture_default_str();
  for (const char* name : {"size", "spacing", "seed"}) {
    add_table_option<PhantomOptions>(*command, std::string("--") + name, *find_option(phantom_options(), name),
                                     [options = &arguments->options]() -> PhantomOptions& { return *options; });
  }
  command->add_option("--out", arguments->out, "folder for the head")->required()->type_name("DIR");
  command->callback([command, arguments, &settings] {
    if (arguments->shape == "cylinder" &&
        command->count("--size") + command->count("--spacing") + command->count("--seed") > 0) {
      throw std::invalid_argument("the cylinder is always the same; leave --size, --spacing and --seed out");
    }
    StageFolder folder(arguments->out, *settings.interruption);
    if (arguments->shape == "cylinder") {
      write_cylinder(folder.path());
    } else {
      write_phantom(arguments->options, folder.path());
    }
    folder.refuse_others_files();
    folder.merge();
  });
}

}  // namespace brainshift::pipelines
