// The `gramap` command: a table of verbs, one place that catches, exit codes.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <vector>

#include "app/fault.h"
#include "app/option_table.h"
#include "app/verbs.h"
#include "geometry/error.h"
#include "version.h"

namespace {

/// Whether all that was printed has arrived: a full disk behind `> table.txt` shows only here.
bool printed() {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "gramap: standard output: cannot be written: %s\n", std::strerror(errno));
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace gramap;
  std::signal(SIGXFSZ, SIG_IGN);  // a file larger than the limit is an error that is told, as a full disk is
  CLI::App app{"Noisy room scans and an interior grammar in, a complete, gap-free 3D floor out.", "gramap"};
  app.set_version_flag("--version", "gramap " GRAMAP_VERSION);
  app.set_help_all_flag("--help-all", "Print the help of every verb and exit");
  set_help(app);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);

  int code = kDone;
  const std::vector<Verb (*)(CLI::App&)> verbs = {
      declare_check,     //
      declare_compress,  //
      declare_document,  //
      declare_explain,   //
      declare_fit,       //
      declare_fmt,       //
      declare_plan,      //
      declare_derive,    //
      declare_export,    //
      declare_evaluate,  //
      declare_learn,     //
      declare_perceive,  //
      declare_simulate,  //
      declare_verify,    //
      declare_view,      //
      declare_train,     //
  };
  for (const auto declare : verbs) {
    const Verb verb = declare(app);
    app.get_subcommands([](const CLI::App*) { return true; }).back()->callback([&code, verb] {
      code = verb();
    });
  }

  try {
    app.parse(argc, argv);
    return printed() ? code : kInputFault;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kUsage;
  } catch (const InputError& error) {
    print_fault(error);
    return kInputFault;
  } catch (const std::filesystem::filesystem_error& error) {
    std::fprintf(stderr, "gramap: %s: %s\n", error.path1().c_str(), error.code().message().c_str());
    return kInputFault;
  } catch (const std::bad_alloc&) {
    std::fputs("gramap: the memory does not suffice for this input\n  help: give a smaller part of it\n",
               stderr);
    return kInputFault;
  } catch (const std::exception& error) {
    std::fprintf(
        stderr,
        "gramap: internal error: %s\n  This is a defect of gramap; please report it with the command line.\n",
        error.what());
    return kDefect;
  }
}
