// batch_runner.cpp -- rounds of rays: all sources of all pings ask, one call traces, all answer.

#include "echo/batch/batch_runner.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "echo/model/hit.h"
#include "echo/model/see_through.h"

namespace insonify {
namespace {

bool ends_here(const SightEnd& end, const Hit& hit) {
  return hit.distance >= end.from && (end.instance == kNoLabel || end.instance == hit.instance);
}

// Finds the lines of sight of a source that continue behind the surfaces that they have met.
void continue_sights(const FlatPlan& plan, AskingSource& source) {
  source.of.clear();
  source.continued.clear();
  const RayList& asked = source.asked;
  for (std::size_t i = 0; i < asked.sights.size(); ++i) {
    const Hit& hit = source.sights[i];
    if (!std::isfinite(hit.distance) || (!asked.ends.empty() && ends_here(asked.ends[i], hit))) {
      continue;
    }
    const Ray& ray = asked.sights[i];
    const double cosine = std::min(std::abs(hit.normal.dot(ray.direction)), 1.0);
    const double transmittance =
        plan.scatter.scattering(surface_label(hit.instance, hit.material)).transmittance(cosine);
    double& passed = source.passed[i];
    if (passed_on(passed * passed, transmittance) > 0) {
      passed *= transmittance;
      source.of.push_back(i);
      source.continued.push_back(ray);
      source.continued.back().min_distance = hit.distance + double{kRayClearance};
    }
  }
  source.met.resize(source.of.size());
}

}  // namespace

// Many views are shared out among the threads, one is computed by all.
template <typename Run>
void BatchRunner::for_each_view(const Run& run) {
  if (views_.size() == 1) {
    run(0, workers_);
    return;
  }
  workers_.for_each(static_cast<int>(views_.size()),
                    [&](int view, int) { run(static_cast<std::size_t>(view), workers_.alone()); });
}

void BatchRunner::ask() {
  for_each_view([&](std::size_t view, Workers& workers) {
    for (AskingSource& source : *sources_[view]) {
      source.found.clear();
      source.asked.clear();
      source.source->ask(views_[view], workers, source.asked);
    }
  });
}

// Traces the rays of a round. False if no source has asked for any.
bool BatchRunner::trace() {
  runs_.clear();
  bool sees_through = false;
  for (std::size_t view = 0; view < views_.size(); ++view) {
    for (AskingSource& source : *sources_[view]) {
      assert(source.asked.ends.empty() || source.asked.ends.size() == source.asked.sights.size());
      source.hits.resize(source.asked.rays.size());
      source.sights.resize(source.asked.sights.size());
      source.passed.clear();
      if (!source.hits.empty()) {
        runs_.push_back({views_[view].placement, source.asked.rays, source.hits, views_[view].refraction});
      }
      if (!source.sights.empty()) {
        runs_.push_back({views_[view].placement, source.asked.sights, source.sights, views_[view].refraction});
        if (views_[view].plan->sees_through()) {
          source.passed.assign(source.sights.size(), 1);
          sees_through = true;
        }
      }
    }
  }
  if (runs_.empty()) {
    return false;
  }
  engine_.trace(runs_);
  if (sees_through) {
    trace_behind();
  }
  return true;
}

// Continues lines of sight behind surfaces that transmit sound.
void BatchRunner::trace_behind() {
  for (int surfaces = 0; surfaces < kMostPassed; ++surfaces) {
    runs_.clear();
    continuing_.clear();
    for (std::size_t view = 0; view < views_.size(); ++view) {
      for (AskingSource& source : *sources_[view]) {
        if (source.passed.empty()) {
          continue;
        }
        continue_sights(*views_[view].plan, source);
        if (!source.continued.empty()) {
          runs_.push_back({views_[view].placement, source.continued, source.met, views_[view].refraction});
          continuing_.push_back(&source);
        }
      }
    }
    if (runs_.empty()) {
      return;
    }
    engine_.trace(runs_);
    for (AskingSource* source : continuing_) {
      for (std::size_t k = 0; k < source->of.size(); ++k) {
        source->sights[source->of[k]] = source->met[k];
      }
    }
  }
}

void BatchRunner::answer() {
  for_each_view([&](std::size_t view, Workers& workers) {
    for (AskingSource& source : *sources_[view]) {
      source.more.clear();
      source.source->answer(views_[view], {source.asked, source.hits, source.sights, source.passed}, workers,
                            source.more, source.found);
      std::swap(source.asked, source.more);
    }
  });
}

void BatchRunner::list_echoes() {
  lists_.clear();
  lists_of_views_.clear();
  for (const SourceSet* sources : sources_) {
    for (const AskingSource& source : *sources) {
      lists_.push_back(&source.found);
    }
  }
  std::size_t first = 0;
  for (const SourceSet* sources : sources_) {
    lists_of_views_.push_back(std::span(lists_).subspan(first, sources->size()));
    first += sources->size();
  }
}

// Sources come first, whose rays would wait for what a device has begun.
void BatchRunner::run(std::span<const PingView> views, std::span<SourceSet* const> sources, EchoReceiver& receiver) {
  assert(views.size() == sources.size());
  views_ = views;
  sources_ = sources;
  ask();
  while (trace()) {
    answer();
  }
  list_echoes();
  batch_->start(views, lists_of_views_);
  batch_->receive(receiver);
}

}  // namespace insonify
