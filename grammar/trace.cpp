#include "grammar/trace.h"

#include <algorithm>
#include <stdexcept>

namespace gramap {
namespace {

/// What is still to be placed: see Cell in row.cpp, of which this is the part that makes the tree.
struct Pending {
  const std::vector<Item>* row = nullptr;  // null: the start symbol
  std::size_t index = 0;
  bool is_begun_repeat = false;
  bool has_scope = false;
  int use = -1;

  const Item& item() const { return (*row)[index]; }
};

class Replay {
 public:
  explicit Replay(const RuleSet& rules) : rules_(rules) { pending_.push_back({}); }

  /// Takes an arc's steps and places its element; returns the use that placed it.
  int place(const Arc& arc) {
    std::size_t taken = 0;
    const auto next_step = [&]() -> const DerivationStep& {
      if (taken >= arc.steps.size()) throw std::logic_error("a derivation has fewer steps than its tree");
      return arc.steps[taken++];
    };
    for (;;) {
      if (pending_.empty()) throw std::logic_error("a derivation places more than its tree holds");
      const Pending head = pending_.back();
      if (head.is_begun_repeat) {
        if (next_step().kind == DerivationStep::Kind::stop)
          pending_.pop_back();
        else
          push(head.item().children, head.use, false);
        continue;
      }
      if (head.row != nullptr && head.item().kind != Item::Kind::piece) {
        pop_item();
        const bool takes_rest = head.has_scope && pending_.empty();
        if (!is_written_out(head.item(), takes_rest)) return head.use;
        if (head.item().kind == Item::Kind::repeat)
          pending_.push_back({head.row, head.index, true, false, head.use});
        else
          push(head.item().children, head.use, takes_rest);
        continue;
      }
      const bool is_last =
          pending_.size() == 1 && (head.row == nullptr || head.index + 1 == head.row->size());
      if (head.row != nullptr && !is_written_out(head.item(), head.has_scope && is_last)) {
        pop_item();
        return head.use;
      }
      const DerivationStep& step = next_step();
      if (step.kind == DerivationStep::Kind::background) return head.use;
      pop_item();
      rewrite(step.rule, head.use);
    }
  }

  Trace take() { return std::move(trace_); }
  Trace& trace_so_far() { return trace_; }

 private:
  void push(const std::vector<Item>& items, int use, bool has_scope) {
    if (!items.empty()) pending_.push_back({&items, 0, false, has_scope, use});
  }

  void pop_item() {
    Pending& head = pending_.back();
    if (head.row == nullptr || head.index + 1 == head.row->size())
      pending_.pop_back();
    else
      ++head.index;
  }

  void rewrite(int rule, int caller) {
    const int symbol = rules_.rules[static_cast<std::size_t>(rule)].symbol;
    int parent = caller;
    for (int use = caller; use >= 0; use = trace_.uses[static_cast<std::size_t>(use)].parent)
      if (rules_.rules[static_cast<std::size_t>(trace_.uses[static_cast<std::size_t>(use)].rule)].symbol ==
          symbol)
        parent = trace_.uses[static_cast<std::size_t>(use)].parent;
    trace_.uses.push_back({rule, parent});
    push(rules_.rules[static_cast<std::size_t>(rule)].body, static_cast<int>(trace_.uses.size()) - 1,
         pending_.empty());
  }

  const RuleSet& rules_;
  std::vector<Pending> pending_;  // the last one is the head
  Trace trace_;
};

}  // namespace

Trace trace(const RuleSet& rules, const Lattice& lattice, const std::vector<PathStep>& path) {
  Replay replay(rules);
  for (const PathStep& step : path) {
    const Arc& arc = lattice.arcs(step.state, step.cell)[static_cast<std::size_t>(step.arc)];
    const Element& element = lattice.row().elements[static_cast<std::size_t>(arc.element)];
    const int by = replay.place(arc);
    Trace& made = replay.trace_so_far();
    const int first = static_cast<int>(made.uses.size());
    for (const InnerUse& inner : element.uses)
      made.uses.push_back({inner.rule, inner.parent < 0 ? by : first + inner.parent});
    made.placed_by.push_back(by);
    made.rooms.emplace_back();
    for (const ElementRoom& room : element.rooms)
      made.rooms.back().push_back(room.use < 0 ? by : first + room.use);
  }
  return replay.take();
}

std::vector<int> rules_down_to(const Trace& trace, int use) {
  std::vector<int> rules;
  for (; use >= 0; use = trace.uses[static_cast<std::size_t>(use)].parent)
    rules.push_back(trace.uses[static_cast<std::size_t>(use)].rule);
  std::reverse(rules.begin(), rules.end());
  return rules;
}

}  // namespace gramap
