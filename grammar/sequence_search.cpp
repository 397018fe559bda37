#include "grammar/sequence_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace gramap {
namespace {

using PrefixPtr = std::shared_ptr<const Prefix>;

constexpr double kNegligible = 1e-16;  // share of a prefix below which its nodes are left out

constexpr double kTolerated = 1e-10;  // share of a prefix that may escape those that dominate it

class Search {
 public:
  Search(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
         const std::vector<double>& posteriors, const SearchLimits& limits)
      : lattice_(lattice),
        completions_(backward),
        posteriors_(posteriors),
        limits_(limits),
        log_total_(log_total(lattice, forward)),
        looks_(looks_of(lattice.row())),
        edges_(lattice),
        departures_(lattice),
        scratch_(lattice.nodes(), 0) {
    for (const int look : looks_) look_count_ = std::max(look_count_, look + 1);
  }

  std::vector<PrefixPtr> run() {
    const PrefixPtr root = empty_prefix();
    dive(root);
    std::vector<PrefixPtr> pending{root};
    while (!pending.empty()) {
      std::vector<PrefixPtr> group = take_leftmost(pending);
      thin_out(group);
      for (const PrefixPtr& prefix : group)
        for (PrefixPtr& child : children(prefix)) pending.push_back(std::move(child));
      std::erase_if(pending, [&](const PrefixPtr& prefix) { return is_hopeless(*prefix); });
    }
    return std::move(found_);
  }

  PrefixPtr follow(const std::vector<int>& looks) {
    PrefixPtr prefix = empty_prefix();
    for (std::size_t i = 0; i < looks.size() && prefix != nullptr; ++i) {
      found_.clear();
      std::vector<PrefixPtr> longer = children(prefix, looks[i]);
      if (i + 1 == looks.size()) return found_.empty() ? nullptr : found_.front();
      prefix = longer.empty() ? nullptr : longer.front();
    }
    return nullptr;
  }

 private:
  PrefixPtr empty_prefix() const {
    const auto [evidence, weight] = lattice_.start();
    auto root = std::make_shared<Prefix>();
    root->layer = {{0, 0, evidence, lattice_.node(0, 0, evidence), 1}};
    root->log_weight = std::log(weight);
    return root;
  }

  /// Follows the most probable child down to a whole sequence: a first bound for the search.
  void dive(PrefixPtr prefix) {
    while (prefix != nullptr) {
      PrefixPtr next;
      for (PrefixPtr& child : children(prefix))
        if (next == nullptr || child->log_posterior > next->log_posterior) next = std::move(child);
      prefix = std::move(next);
    }
  }

  /// Prefixes that end at about the same place; none of them can become another of them.
  std::vector<PrefixPtr> take_leftmost(std::vector<PrefixPtr>& pending) const {
    double least = std::numeric_limits<double>::infinity();
    for (const PrefixPtr& prefix : pending) least = std::min(least, prefix->mean_cell);
    const double reach = least + std::max(1, lattice_.shortest());
    const auto middle = std::stable_partition(pending.begin(), pending.end(),
                                              [&](const PrefixPtr& p) { return p->mean_cell >= reach; });
    std::vector<PrefixPtr> group(std::make_move_iterator(middle), std::make_move_iterator(pending.end()));
    pending.erase(middle, pending.end());
    return group;
  }

  bool is_hopeless(const Prefix& prefix) const {
    if (found_.size() < static_cast<std::size_t>(limits_.sequences)) return false;
    const double worst = found_.back()->log_posterior;
    return prefix.log_posterior <= worst - 1e-12;
  }

  /// Drops prefixes that as many others dominate as sequences are wanted, and those beyond the beam.
  void thin_out(std::vector<PrefixPtr>& group) const {
    std::stable_sort(group.begin(), group.end(), [](const PrefixPtr& a, const PrefixPtr& b) {
      return a->log_posterior > b->log_posterior;
    });
    std::vector<PrefixPtr> kept;
    for (const PrefixPtr& prefix : group) {
      if (kept.size() >= static_cast<std::size_t>(limits_.beam)) break;
      if (is_hopeless(*prefix)) continue;
      int dominating = 0;
      for (const PrefixPtr& other : kept) dominating += dominates(*other, *prefix) ? 1 : 0;
      if (dominating < limits_.sequences) kept.push_back(prefix);
    }
    group = std::move(kept);
  }

  /// Weight of completing a layout from a node, as a multiple of exp(reference).
  double completion(const LayerNode& node, double reference) const {
    const double scale = completions_.log_scale[static_cast<std::size_t>(node.cell)];
    return completions_.value[node.node] * (scale == reference ? 1 : std::exp(scale - reference));
  }

  /// Whether `a` is no worse than `b` at every node, but for a share of `b` that no sequence it begins can
  /// gain more than.
  bool dominates(const Prefix& a, const Prefix& b) const {
    const double factor = std::exp(a.log_weight - b.log_weight);
    const double reference = completions_.log_scale[static_cast<std::size_t>(b.layer.front().cell)];
    double all = 0;
    double excess = 0;
    auto at = a.layer.begin();
    for (const LayerNode& node : b.layer) {
      while (at != a.layer.end() && at->place() < node.place()) ++at;
      const bool met = at != a.layer.end() && at->place() == node.place();
      const double weight = completion(node, reference);
      all += weight * node.sum;
      excess += weight * std::max(0.0, node.sum - (met ? at->sum * factor : 0));
    }
    return excess <= kTolerated * all;
  }

  /// All prefixes that are one element longer; whole sequences among them go to `found_`. `only`: a look that
  /// the element must have.
  std::vector<PrefixPtr> children(const PrefixPtr& prefix, int only = -1) {
    std::vector<PrefixPtr> made;
    for (int look = 0; look < look_count_; ++look) {
      if (only >= 0 && look != only) continue;
      touched_.clear();
      for (auto from = prefix->layer.begin(); from != prefix->layer.end();) {
        const int cell = from->cell;
        const int e = from->evidence_state;
        for (; from != prefix->layer.end() && from->cell == cell && from->evidence_state == e; ++from)
          for (const Arc& arc : lattice_.arcs(from->state, cell))
            if (looks_[static_cast<std::size_t>(arc.element)] == look) departures_.add(arc, from->sum);
        departures_.take([&](int id, double factor) {
          const Emission& emission = lattice_.row().emissions[static_cast<std::size_t>(id)];
          for (const Move& move : edges_.moves(cell, emission.element, e)) {
            add_scaled(move, factor,
                       &scratch_[lattice_.node(move.first_cell, emission.target, move.target_evidence)]);
            touch(move.target_evidence, emission.target, move.first_cell, move.last_cell());
          }
        });
      }
      if (touched_.empty()) continue;
      std::vector<LayerNode> inner;
      std::vector<LayerNode> end;
      collect(inner, end);
      if (PrefixPtr whole = make_prefix(prefix, look, std::move(end))) keep_found(std::move(whole));
      if (PrefixPtr child = make_prefix(prefix, look, std::move(inner)))
        if (!is_hopeless(*child)) made.push_back(std::move(child));
    }
    return made;
  }

  /// Takes note that `scratch_` holds something at these cells, inclusive.
  void touch(int evidence_state, int state, int first, int last) {
    for (Touched& known : touched_) {
      if (known.evidence_state != evidence_state || known.state != state) continue;
      known.first = std::min(known.first, first);
      known.last = std::max(known.last, last);
      return;
    }
    touched_.push_back({evidence_state, state, first, last});
  }

  /// What `scratch_` holds, by cell, evidence state and state; leaves it empty.
  void collect(std::vector<LayerNode>& inner, std::vector<LayerNode>& end) {
    std::sort(touched_.begin(), touched_.end(), [](const Touched& a, const Touched& b) {
      return std::tie(a.evidence_state, a.state) < std::tie(b.evidence_state, b.state);
    });
    int first = lattice_.grid().cells;
    int last = 0;
    for (const Touched& touched : touched_) {
      first = std::min(first, touched.first);
      last = std::max(last, touched.last);
    }
    for (int cell = first; cell <= last; ++cell) {
      const bool at_end = cell == lattice_.grid().cells;
      for (const auto& [e, state, from, to] : touched_) {
        if (cell < from || cell > to) continue;
        const std::size_t node = lattice_.node(cell, state, e);
        double value = std::exchange(scratch_[node], 0);
        if (at_end) value *= lattice_.row().accept[static_cast<std::size_t>(state)];
        if (value <= 0 || posteriors_[node] < kDeadPosterior || !lattice_.is_alive(cell, e)) continue;
        (at_end ? end : inner).push_back({cell, state, e, node, value});
      }
    }
  }

  PrefixPtr make_prefix(const PrefixPtr& before, int look, std::vector<LayerNode> layer) const {
    if (layer.empty()) return nullptr;
    auto prefix = std::make_shared<Prefix>();
    const double reference = completions_.log_scale[static_cast<std::size_t>(layer.front().cell)];
    const auto promise = [&](const LayerNode& node) {
      if (node.cell == lattice_.grid().cells) return node.sum;  // the end is accounted for
      return node.sum * completion(node, reference);
    };
    std::vector<double> promises;
    double all = 0;
    double mean = 0;
    double most = 0;
    for (const LayerNode& node : layer) {
      promises.push_back(promise(node));
      all += promises.back();
      mean += promises.back() * node.cell;
      most = std::max(most, promises.back());
    }
    if (!(all > 0)) return nullptr;
    double sum = 0;
    for (std::size_t i = 0; i < layer.size(); ++i) {
      if (promises[i] < kNegligible * most) continue;
      sum += layer[i].sum;
      prefix->layer.push_back(layer[i]);
    }
    for (LayerNode& node : prefix->layer) node.sum /= sum;
    prefix->before = before;
    prefix->look = look;
    prefix->log_weight = before->log_weight + std::log(sum);
    prefix->log_posterior = before->log_weight + std::log(all) + reference - log_total_;
    prefix->mean_cell = mean / all;
    return prefix;
  }

  void keep_found(PrefixPtr whole) {
    const auto same = [&](const PrefixPtr& other) {
      const Prefix* a = whole.get();
      const Prefix* b = other.get();
      while (a != nullptr && b != nullptr && a->look == b->look) {
        a = a->before.get();
        b = b->before.get();
      }
      return a == nullptr && b == nullptr;
    };
    if (std::any_of(found_.begin(), found_.end(), same)) return;  // the dive found it before
    const auto place = std::find_if(found_.begin(), found_.end(), [&](const PrefixPtr& other) {
      return other->log_posterior < whole->log_posterior;
    });
    found_.insert(place, std::move(whole));
    if (found_.size() > static_cast<std::size_t>(limits_.sequences)) found_.pop_back();
  }

  const Lattice& lattice_;
  const NodeTable& completions_;
  const std::vector<double>& posteriors_;
  SearchLimits limits_;
  double log_total_;
  std::vector<int> looks_;
  int look_count_ = 0;
  Edges edges_;
  Departures departures_;
  std::vector<double> scratch_;  // [node]; zero but while children are made
  struct Touched {
    int evidence_state, state, first, last;
  };
  std::vector<Touched> touched_;  // of scratch_
  std::vector<PrefixPtr> found_;
};

}  // namespace

ElementLook look(const Element& element) {
  ElementLook look;
  for (const ElementRoom& room : element.rooms) {
    look.types.push_back(room.type);
    look.depths_m.push_back(room.depth_start_m);
    look.depths_m.push_back(room.depth_m);
  }
  return look;
}

std::vector<int> looks_of(const Row& row) {
  std::vector<ElementLook> known;
  std::vector<int> ids;
  for (const Element& element : row.elements) {
    const ElementLook wanted = look(element);
    const auto place = std::find(known.begin(), known.end(), wanted);
    ids.push_back(static_cast<int>(place - known.begin()));
    if (place == known.end()) known.push_back(wanted);
  }
  return ids;
}

std::vector<PrefixPtr> most_probable_sequences(const Lattice& lattice, const NodeTable& forward,
                                               const NodeTable& backward,
                                               const std::vector<double>& posteriors,
                                               const SearchLimits& limits) {
  return Search(lattice, forward, backward, posteriors, limits).run();
}

PrefixPtr sequence_of(const Lattice& lattice, const NodeTable& forward, const NodeTable& backward,
                      const std::vector<double>& posteriors, const std::vector<int>& looks) {
  return Search(lattice, forward, backward, posteriors, {2, 1}).follow(looks);
}

}  // namespace gramap
