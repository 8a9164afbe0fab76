// SPDX-FileCopyrightText: 2026 The vantage authors
// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <vector>

#include <vantage/concepts/channels.hpp>
#include <vantage/core/rng.hpp>
#include <vantage/maps/surfel/choose_batch.hpp>
#include <vantage/maps/surfel/rasteriser.hpp>
#include <vantage/maps/surfel/surfel_adam.hpp>
#include <vantage/maps/surfel/surfel_loss.hpp>
#include <vantage/maps/surfel/surfels.hpp>
#include <vantage/maps/surfel/training_frame.hpp>

namespace vantage {

/// What the loss of a frame is computed from.
using TrainingImages = Rendering<channel::Colour, channel::Depth, channel::Normal, channel::Opacity>;

/// Trains surfels on frames (section 6.1.2): each iteration renders a batch of them, and takes one step of Adam down
/// the sum of their gradients. Keeps memory from call to call, and nothing else.
template <SurfelRasteriser Rasteriser, class Variation>
class SurfelTrainer {
 public:
  SurfelTrainer(const LossWeights& weights, const LearningRates& rates) : loss_(weights), adam_(rates) {}

  /// Adam's state is made anew. Frames learn their new errors. Nothing happens without frames or surfels. The same bits
  /// with any number of threads.
  void operator()(Surfels& surfels, std::vector<TrainingFrame>& frames, const BatchConfig& config, int iterations,
                  const Rasteriser& rasteriser, typename Rasteriser::Pass& pass, Rng& rng) {
    if (frames.empty() || surfels.size() == 0 || iterations <= 0) return;
    adam_.restart(surfels.size());
    std::vector<double> errors(frames.size());
    for (int k = 0; k < iterations; ++k) {
      for (std::size_t i = 0; i < frames.size(); ++i) errors[i] = frames[i].error;
      gradient_.reset(surfels.size());
      for (const std::size_t i : choose_batch(errors, config, rng)) {
        TrainingFrame& frame = frames[i];
        const RasterView view{.view = frame.view, .camera = frame.camera};
        rasteriser.forward(surfels, view, pass, drawn_);
        const LossTerms terms = loss_(frame.camera, drawn_, frame, by_image_);
        frame.error = terms.colour + terms.depth;
        rasteriser.backward(surfels, view, pass, by_image_, gradient_);
      }
      adam_.step(surfels, gradient_);
    }
  }

 private:
  SurfelLoss<Variation> loss_;
  SurfelAdam adam_;
  SurfelGradient gradient_;
  TrainingImages drawn_;
  ImageGradient by_image_;
};

}  // namespace vantage
