// Random forests (Breiman 2001) that tell kinds of things apart by a few features, and the small files they
// ship in.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace gramap {

struct Forest {
  std::string task;                   ///< what it tells apart: "openings", "furniture"
  std::vector<std::string> features;  ///< names, in the order that samples have them
  std::vector<std::string> classes;

  /// Trees one after another in preorder. `feature` ≥ 0: go left when the sample's value is at most
  /// `threshold`; the left child follows, the right child is at `right`. `feature` < 0: a leaf of class −1 −
  /// feature.
  struct Node {
    int feature = -1;
    float threshold = 0;
    int right = 0;
  };
  std::vector<Node> nodes;
  std::vector<int> roots;

  /// Share of the trees' votes for each class.
  std::vector<double> votes(std::span<const float> sample) const;
};

struct Sample {
  std::vector<float> features;
  int label = 0;  ///< index into the classes
  int group = 0;  ///< what it comes from, a building for instance: splits never part a group
};

struct ForestOptions {
  int trees = 100;
  int max_depth = 14;
  int least_samples = 4;  ///< in a node that is split further
  std::uint64_t seed = 1;
};

/// Trains by OpenCV's random trees, √n features a split. Same samples, options and seed: same forest.
Forest train_forest(const std::string& task, const std::vector<std::string>& features,
                    const std::vector<std::string>& classes, const std::vector<Sample>& samples,
                    const ForestOptions& options);

/// The model file: a text of one line a tree. Reading throws InputError for another version, another task,
/// other features or classes than asked for, or a file that is damaged.
std::string to_text(const Forest& forest);
Forest forest_from_text(const std::string& text, const std::string& task,
                        const std::vector<std::string>& features, const std::vector<std::string>& classes,
                        const std::filesystem::path& name);

}  // namespace gramap
