#include "renderers/rasterizer.hpp"

#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon::renderers {

namespace {

[[noreturn]] void refuse(const char* what)
{
    throw std::logic_error{std::string{"this rasterizer cannot "} + what};
}

} // namespace

scene::Image<std::uint32_t> ShadowMap::triangles() const
{
    throw std::invalid_argument{"ShadowMap::triangles: the map was drawn without triangles"};
}

std::shared_ptr<const FilteredMap> Rasterizer::filter_map(std::shared_ptr<const ShadowMap> map,
                                                          const scene::Job&, const scene::View&,
                                                          FilteredContent)
{
    return std::make_shared<FilteredMap>(std::move(map));
}

std::shared_ptr<const FilteredMap> Rasterizer::store_map(const scene::Job&, const scene::View&,
                                                         const ExactDepths&)
{
    refuse("store a map");
}

std::optional<scene::LookupTerms> Rasterizer::read_terms(const LookupRequest&)
{
    return std::nullopt;
}

scene::Image<float> Rasterizer::find_critical_biases(const LookupRequest&, float)
{
    refuse("find critical biases");
}

std::vector<scene::Vec2d> Rasterizer::sample_places(int)
{
    refuse("query sample positions");
}

std::vector<scene::OffsetUnit> Rasterizer::measure_offset_units(scene::DepthFormat)
{
    refuse("measure polygon offset units");
}

std::shared_ptr<const FilteredMap> draw_filtered_map(Rasterizer& rasterizer, const scene::Job& job,
                                                     const scene::View& view,
                                                     FilteredContent content)
{
    return rasterizer.filter_map(rasterizer.draw_map(job, view, {}), job, view, content);
}

} // namespace gnomon::renderers
