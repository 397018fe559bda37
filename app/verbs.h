// The verbs of the command. Each is declared and carried out in the file of its name: `gramap fit` in
// fit.cpp.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace gramap {

/// What `main` returns to the shell; README documents them.
enum ExitCode {
  kDone = 0,        ///< complete and verified
  kInputFault = 1,  ///< said where and why; nothing written
  kUsage = 2,
  kDefect = 3,    ///< a defect of gramap
  kSetAside = 4,  ///< written, but some input had to be set aside
};

/// Adds a verb to the command; the returned function runs it once the options are parsed.
using Verb = std::function<int()>;
Verb declare_check(CLI::App& gramap);
Verb declare_compress(CLI::App& gramap);
Verb declare_document(CLI::App& gramap);
Verb declare_explain(CLI::App& gramap);
Verb declare_fit(CLI::App& gramap);
Verb declare_fmt(CLI::App& gramap);
Verb declare_plan(CLI::App& gramap);
Verb declare_derive(CLI::App& gramap);
Verb declare_export(CLI::App& gramap);
Verb declare_perceive(CLI::App& gramap);
Verb declare_evaluate(CLI::App& gramap);
Verb declare_learn(CLI::App& gramap);
Verb declare_simulate(CLI::App& gramap);
Verb declare_verify(CLI::App& gramap);
Verb declare_view(CLI::App& gramap);
Verb declare_train(CLI::App& gramap);

}  // namespace gramap
