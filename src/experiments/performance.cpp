// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
#include "eigengrasp/experiments/performance.hpp"

#include <functional>

#include "eigengrasp/core/error.hpp"
#include "eigengrasp/core/random.hpp"
#include "eigengrasp/core/stop_watch.hpp"
#include "eigengrasp/core/temporary_folder.hpp"
#include "eigengrasp/experiments/statistics.hpp"
#include "eigengrasp/grasp/contact_finder.hpp"
#include "eigengrasp/planning/finger_closing.hpp"
#include "eigengrasp/planning/grasp_energy.hpp"

namespace eigengrasp {

namespace {

double time_of(const std::function<void()>& work) {
  const StopWatch watch;
  work();
  return watch.seconds();
}

/// Calls work at least once, and again until the time is up.
void repeat(double seconds, const StopFlag* stop, const std::function<void()>& work) {
  const StopWatch watch;
  do {
    work();
  } while (watch.seconds() < seconds && !(stop && stop->stop_requested()));
}

/// A new cache that knows only what is on disk.
std::shared_ptr<PreparationCache> cache_in(const TemporaryFolder& folder) {
  return std::make_shared<PreparationCache>(PreparationCacheOptions{.folder = folder.path()});
}

PlanOptions plan_options(const PerformanceOptions& options, int threads, std::uint64_t seed) {
  PlanOptions plan;
  plan.iterations = options.iterations;
  plan.search = options.search;
  plan.threads = threads;
  plan.seed = seed;
  plan.stop = options.stop;
  return plan;
}

/// The planner's runs on so many threads.
class RunBench {
 public:
  RunBench(const Scene& scene, const PerformanceOptions& options, int threads, bool judge_all = false)
      : scene_(scene), options_(options), threads_(threads), judge_all_(judge_all) {}

  int threads() const { return threads_; }

  /// The next seed. @return of the run
  PlanResult run(std::shared_ptr<PreparationCache> cache) {
    PlanOptions plan = plan_options(options_, threads_, run_.size() + 1);
    plan.cache = std::move(cache);
    plan.judge_all = judge_all_;
    PlanResult result = plan_grasps(scene_, plan);
    run_.push_back(result.timings.total - result.timings.prepare - result.timings.volume);
    rate_.push_back(static_cast<double>(result.states.evaluated) / result.timings.anneal);
    evaluated_ += result.states.evaluated;
    legal_ += result.states.legal;
    return result;
  }

  int runs() const { return static_cast<int>(run_.size()); }
  double legal_share() const {
    return evaluated_ > 0 ? static_cast<double>(legal_) / static_cast<double>(evaluated_) : 0.0;
  }
  double median_run() const { return median(run_); }
  double median_rate() const { return median(rate_); }

 private:
  const Scene& scene_;
  const PerformanceOptions& options_;
  int threads_;
  bool judge_all_;
  std::vector<double> run_, rate_;
  std::int64_t evaluated_ = 0;
  std::int64_t legal_ = 0;
};

/// Runs of the planner, and of the paper's search, on so many threads.
class ThreadBench {
 public:
  ThreadBench(const Scene& scene, const PerformanceOptions& options, const PerformanceOptions& as_the_paper,
              int threads)
      : ours_(scene, options, threads), paper_(scene, as_the_paper, threads) {}

  /// All made anew. @return of the run
  PlanResult run_first() {
    PlanResult first = ours_.run(nullptr);
    prepare_ = first.timings.prepare;
    return first;
  }
  void run(const TemporaryFolder& folder) {
    cached_.push_back(ours_.run(cache_in(folder)).timings.prepare);
    paper_.run(cache_in(folder));
  }

  int runs() const { return ours_.runs(); }
  ThreadedPerformance figures() const {
    ThreadedPerformance by;
    by.threads = ours_.threads();
    by.prepare = prepare_;
    by.prepare_cached = median(cached_);
    by.run = ours_.median_run();
    by.paper_run = paper_.median_run();
    by.states_per_second = ours_.median_rate();
    return by;
  }

 private:
  RunBench ours_, paper_;
  double prepare_ = 0.0;
  std::vector<double> cached_;
};

/// Runs on one thread and on all take turns until the time is up. @return the result with seed 1
PlanResult measure_runs(const Scene& scene, const PerformanceOptions& options, const TemporaryFolder& folder,
                        ScenePerformance& out) {
  PerformanceOptions as_the_paper = options;
  as_the_paper.search = SearchKind::paper;
  const int all = options.threads > 0 ? options.threads : hardware_threads();
  std::vector<ThreadBench> benches;
  benches.emplace_back(scene, options, as_the_paper, 1);
  if (all > 1) benches.emplace_back(scene, options, as_the_paper, all);
  PlanResult first;
  for (ThreadBench& bench : benches) {
    reset_peak_memory();
    first = bench.run_first();
  }
  benches.front().run(folder);  // fills the folder
  repeat(options.seconds * static_cast<double>(benches.size()), options.stop, [&] {
    for (ThreadBench& bench : benches) bench.run(folder);
  });
  for (const ThreadBench& bench : benches) out.by_threads.push_back(bench.figures());
  out.peak_memory = peak_memory();
  out.runs = benches.front().runs();
  return first;
}

/// How many states a second are judged to the end, and how many of them are legal.
void measure_judging(const Scene& scene, const PerformanceOptions& options, const TemporaryFolder& folder,
                     ScenePerformance& out) {
  RunBench judged(scene, options, 1, true);
  const auto cache = cache_in(folder);
  repeat(options.seconds, options.stop, [&] { judged.run(cache); });
  out.legal_share = judged.legal_share();
  out.judged_per_second = judged.median_rate();
}

/// Tests the pre-grasps that a search found, step by step.
class CandidateBench {
 public:
  CandidateBench(const Scene& scene, const PlanOptions& plan, const std::vector<Grasp>& grasps)
      : model_(scene, CollisionModel::Options{}), energy_(model_, plan), grasps_(grasps) {}

  /// Seconds of all candidates together, for each step.
  CandidateSteps round() {
    CandidateSteps t;
    closed_.resize(grasps_.size());
    points_.resize(grasps_.size());
    t.close = time_of([&] {
      for (std::size_t i = 0; i < grasps_.size(); ++i) closed_[i] = close(grasps_[i]);
    });
    t.contacts = time_of([&] {
      for (std::size_t i = 0; i < grasps_.size(); ++i) points_[i] = contacts_of(closed_[i]);
    });
    t.closure = time_of([&] {
      for (const auto& points : points_) (void)has_form_closure(points, energy_.wrench_space());
    });
    t.epsilon = time_of([&] {
      for (const auto& points : points_) (void)compute_epsilon(points, energy_.wrench_space());
    });
    return t;
  }

  /// Seconds of all candidates together on several threads.
  double round(int threads) const {
    return time_of([&] {
      parallel_for(grasps_.size(), threads, [&](std::size_t i, int) {
        (void)compute_epsilon(contacts_of(close(grasps_[i])), energy_.wrench_space());
      });
    });
  }

  /// Mean of a candidate, after a round.
  double contacts() const {
    double sum = 0.0;
    for (const auto& points : points_) sum += static_cast<double>(points.size());
    return points_.empty() ? 0.0 : sum / static_cast<double>(points_.size());
  }

 private:
  ClosedHand close(const Grasp& g) const { return close_fingers(model_, g.X_OH_pregrasp, g.pregrasp_dofs); }
  std::vector<ContactPoint> contacts_of(const ClosedHand& closed) const {
    return contact_points(find_contacts(model_, closed.X_OL, {}, &closed.proximity));
  }

  CollisionModel model_;
  GraspEnergy energy_;
  const std::vector<Grasp>& grasps_;
  std::vector<ClosedHand> closed_;
  std::vector<std::vector<ContactPoint>> points_;
};

void measure_candidates(const Scene& scene, const PerformanceOptions& options,
                        const std::vector<Grasp>& grasps, ScenePerformance& out) {
  out.candidates = static_cast<int>(grasps.size());
  if (grasps.empty()) return;
  const auto n = static_cast<double>(grasps.size());
  CandidateBench bench(scene, plan_options(options, 1, 1), grasps);
  std::vector<double> close, contacts, closure, epsilon, whole;
  repeat(options.seconds, options.stop, [&] {
    const CandidateSteps t = bench.round();
    close.push_back(t.close / n);
    contacts.push_back(t.contacts / n);
    closure.push_back(t.closure / n);
    epsilon.push_back(t.epsilon / n);
    whole.push_back((t.close + t.contacts + t.epsilon) / n);
  });
  out.steps = {median(close), median(contacts), median(closure), median(epsilon)};
  out.contacts = bench.contacts();
  for (ThreadedPerformance& by : out.by_threads) {
    if (by.threads != 1) {
      whole.clear();
      repeat(options.seconds, options.stop, [&] { whole.push_back(bench.round(by.threads) / n); });
    }
    by.candidates_per_second = 1.0 / median(whole);
  }
}

/// What a new object costs before anything can be planned on it; its file is read already.
double prepare_object(const ObjectModel& object, int threads) {
  DistanceFieldOptions options;
  options.threads = threads;
  return time_of([&] {
    const ObjectModel anew = make_object(object.name, object.mesh);
    const DistanceField field(anew.bvh, options);
  });
}

}  // namespace

ScenePerformance measure_performance(const Scene& scene, const PerformanceOptions& options) {
  ScenePerformance out;
  out.hand = scene.hand->name;
  out.object = scene.object->name;
  const TemporaryFolder folder("bench");
  const PlanResult first = measure_runs(scene, options, folder, out);
  out.closed_on_the_way = first.closed_on_the_way;
  measure_judging(scene, options, folder, out);
  measure_candidates(scene, options, first.grasps, out);
  out.triangles = static_cast<std::int64_t>(scene.object->mesh.triangles.size());
  for (ThreadedPerformance& by : out.by_threads) {
    std::vector<double> times;
    repeat(options.seconds, options.stop,
           [&] { times.push_back(prepare_object(*scene.object, by.threads)); });
    by.prepare_object = median(times);
  }
  return out;
}

WrenchPerformance measure_wrench_space(double seconds) {
  constexpr std::size_t sets = 64;
  constexpr int contacts_of_a_set = 8;
  const Vec3 half_axes(0.03, 0.04, 0.05);  // [m]
  WrenchSpaceOptions options;
  options.torque_scale = half_axes.maxCoeff();
  std::vector<std::vector<ContactPoint>> all(sets);
  for (std::size_t set = 0; set < sets; ++set) {
    RandomStream random{set};
    for (int i = 0; i < contacts_of_a_set; ++i) {
      const Vec3 u = Vec3(random.normal(), random.normal(), random.normal()).normalized();
      ContactPoint contact;
      contact.p_OC = half_axes.cwiseProduct(u);
      contact.n_OC = -u.cwiseQuotient(half_axes).normalized();
      contact.mu = 0.5;
      all[set].push_back(contact);
    }
  }
  std::vector<double> epsilon, closure;
  repeat(seconds, nullptr, [&] {
    epsilon.push_back(time_of([&] {
      for (const auto& contacts : all) (void)compute_epsilon(contacts, options);
    }));
    closure.push_back(time_of([&] {
      for (const auto& contacts : all) (void)has_form_closure(contacts, options);
    }));
  });
  return {median(epsilon) / static_cast<double>(sets), median(closure) / static_cast<double>(sets)};
}

}  // namespace eigengrasp
