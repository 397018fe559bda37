// A fitted floor against the truth, element by element.
//
// Rooms are matched by the plan area that they share (best intersection over union first). Widths are
// measured along the space's reference line. Walls are compared as the field does for line data (completeness
// and correctness within a buffer, ISPRS benchmark on indoor modelling, Khoshelham et al. 2020): how much of
// the true wall length has a wall of the model within the buffer, and the other way round. Openings match at
// an intersection over union of one half on the wall's face, furniture at one half in the plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "floor/fitted_floor.h"
#include "floor/ground_truth.h"

namespace gramap {

struct RoomScore {
  std::string id;       ///< in the model; empty: a true room that the model lacks
  std::string true_id;  ///< empty: a room of the model that does not exist
  std::string space;
  std::string type, true_type;
  Origin origin = Origin::derived;
  std::optional<double> extracted_width_m;  ///< what the scan said
  double width_m = 0;                       ///< after the grammar
  double true_width_m = 0;
  double sigma_m = 0;
  double iou = 0;
  double type_probability = 1;
  Polygon outline;  ///< the model's, or the true one when the model has none

  bool matched() const { return !id.empty() && !true_id.empty(); }
  double error_m() const { return width_m - true_width_m; }
};

/// Errors of a number of lengths, metres.
struct ErrorSummary {
  int count = 0;
  double mean_abs_m = 0;
  double median_abs_m = 0;
  double rms_m = 0;
  double worst_m = 0;
  double within_2cm = 0;  ///< shares, 0 to 1
  double within_10cm = 0;
};

struct WallScore {
  double buffer_m = 0;
  double completeness = 0;  ///< share of true wall length with a wall of the model within the buffer
  double correctness = 0;   ///< share of the model's wall length with a true wall within the buffer
};

/// Found, missed and invented things of one kind.
struct DetectionScore {
  std::string kind;  ///< "door", "window", or a class of furniture
  int matched = 0;
  int truth = 0;
  int model = 0;
  double recall() const { return truth == 0 ? 1 : static_cast<double>(matched) / truth; }
  double precision() const { return model == 0 ? 1 : static_cast<double>(matched) / model; }
};

/// Of the rooms that the fit gave a type probability between the bounds, how many are right: there, and of
/// this type.
struct ReliabilityBin {
  double least = 0, most = 0;
  int count = 0;
  int right = 0;
  double mean_probability = 0;
};

struct SpaceScore {
  std::string id;
  int rooms = 0;
  int true_rooms = 0;
  bool in_order = false;  ///< every true room is there, in its place, and none besides
};

struct Evaluation {
  std::vector<RoomScore> rooms;  ///< the model's in its order, then the missing ones
  std::vector<SpaceScore> spaces;
  ErrorSummary extracted;                 ///< before the grammar
  ErrorSummary observed;                  ///< after it, of the same rooms
  ErrorSummary derived;                   ///< of the rooms that nobody scanned
  std::vector<WallScore> walls;           ///< at 5 and 10 cm, of all rooms
  std::vector<WallScore> observed_walls;  ///< of the observed rooms
  double wall_median_m = 0;               ///< median distance of the found true walls
  std::vector<DetectionScore> openings;   ///< doors, windows: of all rooms
  std::vector<DetectionScore>
      observed_openings;  ///< of those that were observed, against the observed rooms'
  std::vector<DetectionScore>
      furniture;                     ///< observed pieces, by class and "all"; recall is of observed rooms
  double furniture_class_right = 1;  ///< share of matched pieces whose class is right
  double within_1_sigma = 0, within_2_sigma = 0, within_3_sigma = 0;  ///< of all rooms with a sigma
  std::vector<ReliabilityBin> reliability;
};

/// `floor` gives the reference lines, where it is known; else a room's width runs along that edge of its
/// outline which its width fits best.
Evaluation evaluate(const FittedFloor& fitted, const FloorTruth& truth, const FloorGroundTruth& floor = {});

/// For people: a table of the rooms and what follows from it.
std::string to_text(const Evaluation& evaluation);
std::string to_json(const Evaluation& evaluation);
/// One page by itself: the plan coloured by error, and the tables.
std::string to_html(const Evaluation& evaluation, const std::string& title);

}  // namespace gramap
