#include "perception/forest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/core/utility.hpp>
#include <opencv2/ml.hpp>
#include <sstream>

#include "geometry/error.h"

namespace gramap {
namespace {

constexpr const char* kMagic = "gramap-forest";
constexpr int kVersion = 1;

/// Copies a tree of OpenCV's in preorder.
void copy_tree(const cv::ml::RTrees& trees, int at, Forest& forest) {
  const auto& node = trees.getNodes()[static_cast<std::size_t>(at)];
  const std::size_t mine = forest.nodes.size();
  forest.nodes.emplace_back();
  if (node.split < 0) {
    forest.nodes[mine].feature = -1 - static_cast<int>(std::lround(node.value));
    return;
  }
  const auto& split = trees.getSplits()[static_cast<std::size_t>(node.split)];
  forest.nodes[mine].feature = split.varIdx;
  forest.nodes[mine].threshold = split.c;
  copy_tree(trees, node.left, forest);
  forest.nodes[mine].right = static_cast<int>(forest.nodes.size());
  copy_tree(trees, node.right, forest);
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

std::vector<std::string> parted(const std::string& text) {
  std::vector<std::string> names;
  std::istringstream in(text);
  for (std::string name; std::getline(in, name, ',');) names.push_back(name);
  return names;
}

/// Reads the numbers of one tree's line; checks that they make a tree.
class TreeReader {
 public:
  TreeReader(const std::string& line, Forest& forest) : in_(line), forest_(forest) {}
  bool read() {
    forest_.roots.push_back(static_cast<int>(forest_.nodes.size()));
    std::string rest;
    return node(0) && !(in_ >> rest);
  }

 private:
  bool node(int depth) {
    int feature = 0;
    if (depth > 64 || !(in_ >> feature)) return false;
    const std::size_t mine = forest_.nodes.size();
    forest_.nodes.push_back({feature, 0, 0});
    if (feature < 0) return -1 - feature < static_cast<int>(forest_.classes.size());
    if (feature >= static_cast<int>(forest_.features.size()) || !(in_ >> forest_.nodes[mine].threshold))
      return false;
    if (!node(depth + 1)) return false;
    forest_.nodes[mine].right = static_cast<int>(forest_.nodes.size());
    return node(depth + 1);
  }
  std::istringstream in_;
  Forest& forest_;
};

}  // namespace

std::vector<double> Forest::votes(std::span<const float> sample) const {
  std::vector<double> share(classes.size());
  for (const int root : roots) {
    int at = root;
    while (nodes[static_cast<std::size_t>(at)].feature >= 0) {
      const Node& node = nodes[static_cast<std::size_t>(at)];
      at = sample[static_cast<std::size_t>(node.feature)] <= node.threshold ? at + 1 : node.right;
    }
    share[static_cast<std::size_t>(-1 - nodes[static_cast<std::size_t>(at)].feature)] +=
        1.0 / static_cast<double>(roots.size());
  }
  return share;
}

Forest train_forest(const std::string& task, const std::vector<std::string>& features,
                    const std::vector<std::string>& classes, const std::vector<Sample>& samples,
                    const ForestOptions& options) {
  cv::Mat values(static_cast<int>(samples.size()), static_cast<int>(features.size()), CV_32F);
  cv::Mat labels(static_cast<int>(samples.size()), 1, CV_32S);
  for (int i = 0; i < values.rows; ++i) {
    const Sample& sample = samples[static_cast<std::size_t>(i)];
    std::copy(sample.features.begin(), sample.features.end(), values.ptr<float>(i));
    labels.at<int>(i) = sample.label;
  }
  const auto trees = cv::ml::RTrees::create();
  trees->setMaxDepth(options.max_depth);
  trees->setMinSampleCount(options.least_samples);
  trees->setActiveVarCount(static_cast<int>(std::lround(std::sqrt(static_cast<double>(features.size())))));
  trees->setTermCriteria({cv::TermCriteria::MAX_ITER, options.trees, 0});
  cv::theRNG().state = options.seed * 2 + 1;  // a state of zero would stay there
  trees->train(values, cv::ml::ROW_SAMPLE, labels);
  Forest forest{task, features, classes, {}, {}};
  for (const int root : trees->getRoots()) {
    forest.roots.push_back(static_cast<int>(forest.nodes.size()));
    copy_tree(*trees, root, forest);
  }
  return forest;
}

std::string to_text(const Forest& forest) {
  std::string text = std::string(kMagic) + " " + std::to_string(kVersion) + " " + forest.task + "\n" +
                     joined(forest.features) + "\n" + joined(forest.classes) + "\n";
  char digits[64];
  for (std::size_t tree = 0; tree < forest.roots.size(); ++tree) {
    const std::size_t end = tree + 1 < forest.roots.size() ? static_cast<std::size_t>(forest.roots[tree + 1])
                                                           : forest.nodes.size();
    for (auto i = static_cast<std::size_t>(forest.roots[tree]); i < end; ++i) {
      const Forest::Node& node = forest.nodes[i];
      if (text.back() != '\n') text += ' ';
      text += std::to_string(node.feature);
      if (node.feature < 0) continue;
      const auto last = std::to_chars(digits, digits + sizeof digits, node.threshold).ptr;
      text.append(" ").append(digits, last);
    }
    text += '\n';
  }
  return text;
}

Forest forest_from_text(const std::string& text, const std::string& task,
                        const std::vector<std::string>& features, const std::vector<std::string>& classes,
                        const std::filesystem::path& name) {
  const std::string advice = "make it again with 'gramap train " + task + "'";
  std::istringstream in(text);
  std::string line, magic, made_for;
  int version = 0;
  std::getline(in, line);
  std::istringstream(line) >> magic >> version >> made_for;
  if (magic != kMagic) throw InputError({name.string(), 1}, "this is no model file of gramap", advice);
  if (version != kVersion)
    throw InputError({name.string(), 1},
                     "the model is of version " + std::to_string(version) + ", this gramap reads version " +
                         std::to_string(kVersion),
                     advice);
  if (made_for != task)
    throw InputError({name.string(), 1}, "the model tells '" + made_for + "' apart, not '" + task + "'",
                     advice);
  Forest forest;
  forest.task = task;
  if (std::getline(in, line)) forest.features = parted(line);
  if (std::getline(in, line)) forest.classes = parted(line);
  if (forest.features != features || forest.classes != classes)
    throw InputError({name.string(), 2}, "the model's features or classes are not this gramap's", advice);
  for (int number = 4; std::getline(in, line); ++number)
    if (!TreeReader(line, forest).read())
      throw InputError({name.string(), number}, "this line is not a decision tree", advice);
  if (forest.roots.empty()) throw InputError({name.string()}, "the model has no trees", advice);
  return forest;
}

}  // namespace gramap
