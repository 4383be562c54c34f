#include "reference_rt/certificate/certificate.hpp"

#include "reference_rt/certificate/pixel.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <random>
#include <stdexcept>

namespace gnomon::reference_rt {

using certificate::BruteForce;
using certificate::Finding;
using certificate::WitnessVerdict;
using scene::ClassReason;
using scene::ImageSize;
using scene::no_triangle;
using scene::PixelClass;

namespace {

constexpr std::size_t most_refutations = 100;

std::size_t code(PixelClass pixel_class)
{
    return static_cast<std::size_t>(pixel_class);
}

float truth_of(PixelClass pixel_class)
{
    if (!scene::is_scored(pixel_class)) {
        return -1.0F;
    }
    return scene::is_lit(pixel_class) ? 1.0F : 0.0F;
}

/// Draws a sample without replacement from a population that is visited once; all subsets of the
/// requested size are equally likely.
class Draw {
public:
    Draw(std::uint64_t population, std::uint64_t wanted)
        : left_{population},
          wanted_{std::min(population, wanted)}
    {
    }

    bool takes_next(std::mt19937_64& random)
    {
        const bool is_taken = below(left_, random) < wanted_;
        if (is_taken) {
            --wanted_;
        }
        --left_;
        return is_taken;
    }

private:
    /// Uniform in [0, bound). Standard distributions differ between libraries.
    static std::uint64_t below(std::uint64_t bound, std::mt19937_64& random)
    {
        constexpr std::uint64_t largest = std::numeric_limits<std::uint64_t>::max();
        const std::uint64_t usable = largest - largest % bound;
        std::uint64_t value = random();
        while (value >= usable) {
            value = random();
        }
        return value % bound;
    }

    std::uint64_t left_;
    std::uint64_t wanted_;
};

/// Counts finished pixels, and reports the count about a hundred times per stage.
class Progress {
public:
    Progress(const CertificateOptions& options, std::string_view stage, std::uint64_t total)
        : options_{options},
          stage_{stage},
          total_{total}
    {
    }

    void add(std::uint64_t pixels)
    {
        const std::uint64_t before = done_.fetch_add(pixels);
        const std::uint64_t step = std::max<std::uint64_t>(total_ / 100, 1);
        if (options_.progress && before / step != (before + pixels) / step) {
            const std::lock_guard lock{mutex_};
            options_.progress(stage_, before + pixels, total_);
        }
    }

private:
    const CertificateOptions& options_;
    std::string_view stage_;
    std::uint64_t total_;
    std::atomic<std::uint64_t> done_ = 0;
    std::mutex mutex_;
};

/// The state of one `certify` call.
class Audit {
public:
    Audit(const scene::TriangleScene& scene, const scene::View& view, const TruthClaims& claims,
          const CertificateOptions& options)
        : scene_{scene},
          view_{view},
          claims_{claims},
          options_{options},
          brute_force_{scene, view},
          is_refuted_(claims.pixel_class.pixel_count())
    {
        for (const PixelClass pixel_class : claims.pixel_class) {
            ++result_.claimed[code(pixel_class)];
        }
        result_.surface_pixels =
            claims.pixel_class.pixel_count() - result_.claimed[code(PixelClass::background)];
    }

    void check_all_pixels()
    {
        const ImageSize size = view_.image;
        Progress progress{options_, "witnesses", size.pixel_count()};
        std::atomic<std::uint64_t> seams = 0;
        std::atomic<std::uint64_t> positions = 0;
        tbb::parallel_for(0, size.height_px, [&](int y) {
            for (int x = 0; x < size.width_px; ++x) {
                check_consistency(x, y);
                if (check_witness(x, y)) {
                    ++seams;
                }
                if (check_position(x, y)) {
                    ++positions;
                }
                if (claims_.pixel_class(x, y) == PixelClass::background) {
                    (void)derive(x, y); // erased data looks like background
                }
            }
            progress.add(static_cast<std::uint64_t>(size.width_px));
        });
        result_.witnesses = result_.claimed[code(PixelClass::blocked)];
        result_.seams = seams;
        result_.positions = positions;
        constexpr auto background = static_cast<std::size_t>(PixelClass::background);
        result_.derived[background] = result_.claimed[background];
    }

    void derive_sample()
    {
        const std::vector<std::size_t> sample = draw_sample();
        std::vector<ClassReason> kinds(sample.size());
        Progress progress{options_, "sample", sample.size()};
        tbb::parallel_for(std::size_t{0}, sample.size(), [&](std::size_t i) {
            kinds[i] = derive(sample[i]);
            progress.add(1);
        });
        for (const std::size_t pixel : sample) {
            ++result_.derived[code(claims_.pixel_class[pixel])];
        }
        const auto count = [&](ClassReason kind) {
            return static_cast<std::uint64_t>(std::ranges::count(kinds, kind));
        };
        result_.silhouettes = count(ClassReason::silhouette);
        result_.vertices = count(ClassReason::vertex);
        result_.grazes = count(ClassReason::graze);
    }

    [[nodiscard]] Certificate take()
    {
        std::ranges::sort(refuted_, {}, &Refuted::pixel);
        for (Refuted& refuted : refuted_) {
            result_.refutations.push_back(std::move(refuted.refutation));
        }
        return std::move(result_);
    }

private:
    struct Refuted {
        std::size_t pixel = 0;
        Refutation refutation;
    };

    /// Checks that a pixel's claims agree with each other.
    void check_consistency(int x, int y)
    {
        const PixelClass claimed = claims_.pixel_class(x, y);
        const float expected = truth_of(claimed);
        // Also true for NaN.
        if (!(claims_.truth(x, y) == expected)) {
            refute(x, y, fmt::format("its truth is {} and not {}", claims_.truth(x, y), expected));
        }
        const std::uint32_t receiver = claims_.receiver(x, y);
        if (claimed == PixelClass::background && receiver != no_triangle) {
            refute(x, y, fmt::format("GL sees triangle {} there", receiver));
        }
        if (!scene::is_blocked(claimed) && claims_.witness(x, y) != no_triangle) {
            refute(x, y,
                   fmt::format("it has the witness {} but is not blocked", claims_.witness(x, y)));
        }
    }

    /// True for a blocked pixel whose witness is a valid seam's.
    bool check_witness(int x, int y)
    {
        if (!scene::is_blocked(claims_.pixel_class(x, y))) {
            return false;
        }
        const WitnessVerdict verdict =
            brute_force_.check_witness(x, y, claims_.receiver(x, y), claims_.witness(x, y));
        if (!verdict.fault.empty()) {
            refute(x, y, verdict.fault);
        }
        return verdict.is_seam;
    }

    /// True for a pixel with a receiver.
    bool check_position(int x, int y)
    {
        const scene::Vec3f& position = claims_.position(x, y);
        const std::uint32_t receiver = claims_.receiver(x, y);
        if (receiver == no_triangle) {
            if (!std::isnan(position.x) || !std::isnan(position.y) || !std::isnan(position.z)) {
                refute(x, y, "it has a P, but GL sees nothing there");
            }
            return false;
        }
        if (std::string fault = brute_force_.check_position(x, y, receiver, position);
            !fault.empty()) {
            refute(x, y, std::move(fault));
        }
        return true;
    }

    /// The kind of an indeterminate pixel.
    ClassReason derive(std::size_t pixel)
    {
        const auto width = static_cast<std::size_t>(view_.image.width_px);
        return derive(static_cast<int>(pixel % width), static_cast<int>(pixel / width));
    }
    ClassReason derive(int x, int y)
    {
        const Finding finding = brute_force_.decide(x, y, claims_.receiver(x, y));
        if (finding.pixel_class != claims_.pixel_class(x, y)) {
            refute(x, y,
                   fmt::format("it is {}: {}", scene::pixel_class_names[code(finding.pixel_class)],
                               explain(finding)));
        }
        return finding.reason;
    }

    /// Counts each pixel once, and keeps the first faults in image order for any thread order.
    void refute(int x, int y, std::string reason)
    {
        const std::size_t pixel =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.image.width_px) +
            static_cast<std::size_t>(x);
        const std::lock_guard lock{mutex_};
        if (is_refuted_[pixel]) {
            return;
        }
        is_refuted_[pixel] = true;
        ++result_.wrong;
        refuted_.push_back({pixel, {x, y, claims_.pixel_class[pixel], std::move(reason)}});
        std::ranges::push_heap(refuted_, {}, &Refuted::pixel);
        if (refuted_.size() > most_refutations) {
            std::ranges::pop_heap(refuted_, {}, &Refuted::pixel);
            refuted_.pop_back();
        }
    }

    /// Row-major indices, in order.
    std::vector<std::size_t> draw_sample()
    {
        const std::uint64_t size = options_.sample.value_or(default_sample_size(scene_));
        std::mt19937_64 random{options_.seed};
        Draw surface{result_.surface_pixels, size};
        result_.sampled = std::min(result_.surface_pixels, size);
        std::vector<std::size_t> chosen;
        Certificate::ClassCounts taken{};
        for (std::size_t i = 0; i < claims_.pixel_class.pixel_count(); ++i) {
            const PixelClass claimed = claims_.pixel_class[i];
            if (claimed != PixelClass::background && surface.takes_next(random)) {
                chosen.push_back(i);
                ++taken[code(claimed)];
            }
        }
        const std::vector<std::size_t> rest = draw_rest(chosen, taken, size, random);
        const auto middle = static_cast<std::ptrdiff_t>(chosen.size());
        chosen.insert(chosen.end(), rest.begin(), rest.end());
        std::inplace_merge(chosen.begin(), chosen.begin() + middle, chosen.end());
        return chosen;
    }

    /// Draws extra pixels for classes that are too rare in the sample.
    [[nodiscard]] std::vector<std::size_t> draw_rest(const std::vector<std::size_t>& chosen,
                                                     const Certificate::ClassCounts& taken,
                                                     std::uint64_t size,
                                                     std::mt19937_64& random) const
    {
        std::vector<Draw> draws;
        for (std::size_t c = 0; c < taken.size(); ++c) {
            const std::uint64_t quota = c == code(PixelClass::background)
                                            ? 0 // all background pixels are derived
                                        : c == code(PixelClass::indeterminate) ? size
                                                                               : (size + 19) / 20;
            draws.emplace_back(result_.claimed[c] - taken[c], quota - std::min(quota, taken[c]));
        }
        std::vector<std::size_t> rest;
        auto next = chosen.begin();
        for (std::size_t i = 0; i < claims_.pixel_class.pixel_count(); ++i) {
            if (next != chosen.end() && *next == i) {
                ++next;
            } else if (draws[code(claims_.pixel_class[i])].takes_next(random)) {
                rest.push_back(i);
            }
        }
        return rest;
    }

    const scene::TriangleScene& scene_;
    const scene::View& view_;
    const TruthClaims& claims_;
    const CertificateOptions& options_;
    BruteForce brute_force_;
    std::mutex mutex_; ///< guards the members that `refute` changes
    std::vector<bool> is_refuted_;
    std::vector<Refuted> refuted_; ///< a heap with the last pixel in image order on top
    Certificate result_;
};

void check_size(ImageSize image, ImageSize view, std::string_view name)
{
    if (image != view) {
        throw std::invalid_argument{
            fmt::format("certify: claims.{} is {}x{} pixels, the view {}x{}", name, image.width_px,
                        image.height_px, view.width_px, view.height_px)};
    }
}

} // namespace

std::uint64_t default_sample_size(const scene::TriangleScene& scene)
{
    return scene.triangles.size() > 100'000 ? 300 : 3'000;
}

std::optional<double> Certificate::error_rate_bound() const
{
    if (!is_certified() || sampled == 0) {
        return std::nullopt;
    }
    return sampled == surface_pixels ? 0.0 : std::min(1.0, 3.0 / static_cast<double>(sampled));
}

Certificate certify(const scene::TriangleScene& scene, const scene::View& view,
                    const TruthClaims& claims, const CertificateOptions& options)
{
    check_size(claims.receiver.size(), view.image, "receiver");
    check_size(claims.pixel_class.size(), view.image, "pixel_class");
    check_size(claims.truth.size(), view.image, "truth");
    check_size(claims.witness.size(), view.image, "witness");
    check_size(claims.position.size(), view.image, "position");
    Audit audit{scene, view, claims, options};
    const auto run = [&] {
        audit.check_all_pixels();
        audit.derive_sample();
    };
    if (options.threads > 0) {
        const tbb::global_control limit{tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(options.threads)};
        tbb::task_arena{options.threads}.execute(run);
    } else {
        run();
    }
    return audit.take();
}

} // namespace gnomon::reference_rt
