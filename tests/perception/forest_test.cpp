#include "perception/forest.h"

#include <doctest/doctest.h>

#include "geometry/error.h"
#include "perception/random.h"

using namespace gramap;

namespace {

/// Two classes: inside a ring and outside of it.
std::vector<Sample> ring_samples(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), noise = random.uniform(-1, 1);
    const double radius = std::hypot(x, y);
    samples.push_back({{static_cast<float>(x), static_cast<float>(y), static_cast<float>(noise)},
                       radius > 0.3 && radius < 0.7 ? 1 : 0,
                       0});
  }
  return samples;
}

Forest ring_forest(std::uint64_t seed = 1) {
  ForestOptions options;
  options.seed = seed;
  options.trees = 40;
  return train_forest("rings", {"x", "y", "noise"}, {"no", "yes"}, ring_samples(5, 1500), options);
}

Forest read(const std::string& text, const std::string& task = "rings") {
  return forest_from_text(text, task, {"x", "y", "noise"}, {"no", "yes"}, "test.forest");
}

}  // namespace

TEST_CASE("a forest learns what it is shown and its votes sum to one") {
  const Forest forest = ring_forest();
  int right = 0;
  const auto samples = ring_samples(6, 500);
  for (const Sample& sample : samples) {
    const auto votes = forest.votes(sample.features);
    CHECK(votes[0] + votes[1] == doctest::Approx(1));
    right += (votes[1] > votes[0]) == (sample.label == 1);
  }
  CHECK(right > 460);
}

TEST_CASE("the same seed makes the same bytes, another seed others") {
  CHECK(to_text(ring_forest(3)) == to_text(ring_forest(3)));
  CHECK(to_text(ring_forest(3)) != to_text(ring_forest(4)));
}

TEST_CASE("a model file reads back as the same forest") {
  const Forest forest = ring_forest();
  const Forest again = read(to_text(forest));
  CHECK(to_text(again) == to_text(forest));
  for (const Sample& sample : ring_samples(7, 100))
    CHECK(again.votes(sample.features) == forest.votes(sample.features));
}

TEST_CASE("model files that do not fit are refused with their reason") {
  const std::string text = to_text(ring_forest());
  const auto fault = [](const std::string& bad, const std::string& task = "rings") -> std::string {
    try {
      read(bad, task);
    } catch (const InputError& error) {
      return to_string(error.place) + ": " + error.what();
    }
    return "accepted";
  };
  std::string other = text;
  other.replace(other.find(" 1 "), 3, " 9 ");
  CHECK(fault(other) == "test.forest:1: the model is of version 9, this gramap reads version 1");
  CHECK(fault(text, "squares") == "test.forest:1: the model tells 'rings' apart, not 'squares'");
  CHECK(fault("hello\n") == "test.forest:1: this is no model file of gramap");
  CHECK(fault("") == "test.forest:1: this is no model file of gramap");
  CHECK(fault(text.substr(0, text.size() - 20)).find("is not a decision tree") != std::string::npos);
  CHECK(fault(text.substr(0, text.find('\n') + 1)).find("features or classes") != std::string::npos);
  const std::string head = text.substr(0, text.find('\n', text.find("no,yes")) + 1);
  CHECK(fault(head) == "test.forest: the model has no trees");
  CHECK(fault(head + "7 0.5 -1 -2\n").find("is not a decision tree") != std::string::npos);
  CHECK(fault(head + "-3\n").find("is not a decision tree") != std::string::npos);
}
