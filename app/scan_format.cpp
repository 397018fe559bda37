#include "app/scan_format.h"

namespace gramap {

void declare_scan_format(CLI::App& verb, ScanFormat& format) {
  verb.add_option("--unit", format.unit,
                  "Length unit of the scans' points; without it metres, and others are refused")
      ->check(CLI::IsMember({"m", "cm", "mm"}));
  verb.add_option("--up", format.up, "The scans' axis that points up")
      ->check(CLI::IsMember({"y", "z"}))
      ->capture_default_str();
}

ReadOptions read_options(const ScanFormat& format) {
  ReadOptions options;
  if (format.unit == "mm") options.unit_m = 0.001;
  if (format.unit == "cm") options.unit_m = 0.01;
  if (format.unit == "m") options.unit_m = 1;
  options.up = format.up == "y" ? 'y' : 'z';
  return options;
}

}  // namespace gramap
