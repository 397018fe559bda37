// The options that say how scans are written, for every verb that reads a folder of them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "perception/scan.h"

namespace gramap {

struct ScanFormat {
  std::string unit;  ///< m, cm or mm; empty: metres, and others are refused
  std::string up = "z";
};

/// Declares --unit and --up; `format` has to outlive the parsing.
void declare_scan_format(CLI::App& verb, ScanFormat& format);

ReadOptions read_options(const ScanFormat& format);

}  // namespace gramap
