#include "api/sweep/sweep_scenes.hpp"

#include "analysis/sweep/stage_keys.hpp"
#include "methods/job_method.hpp"
#include "scene/load/load_scene.hpp"

#include <utility>

namespace gnomon::api {

SceneContent content_of(const scene::SceneFile& file)
{
    SceneContent content{
        scene::content_hash(file.scene), scene::normals_hash(file.scene), file.defaults, {}};
    for (const scene::LeftToFile left :
         {scene::LeftToFile{false, false}, {false, true}, {true, false}, {true, true}}) {
        content.notes[left] = scene::scene_notes(file.scene, file.defaults, left);
    }
    return content;
}

scene::VertexNormals needed_normals(const analysis::SweepCurves& curves)
{
    for (std::size_t i = 0; i < curves.requests().size(); ++i) {
        if (methods::vertex_normals(curves.job(i)) == scene::VertexNormals::kept) {
            return scene::VertexNormals::kept;
        }
    }
    return scene::VertexNormals::dropped;
}

SweepScenes::SweepScenes(const raster_gl::Context& context, const SessionOptions& options,
                         scene::VertexNormals normals, SceneLoader load)
    : context_{context},
      options_{options},
      normals_{normals},
      load_{std::move(load)}
{
}

void SweepScenes::read(const scene::Job& job)
{
    std::string key = analysis::stage_keys(job).scene;
    if (file_ != nullptr && key == key_) {
        return;
    }
    loaded_scene_.reset(); // refers to the file
    file_.reset();
    file_ = std::make_unique<scene::SceneFile>(load_ ? load_(job, normals_)
                                                     : scene::load_scene(job.scene, normals_));
    key_ = std::move(key);
}

SceneContent SweepScenes::content(const scene::Job& job)
{
    read(job);
    return content_of(*file_);
}

analysis::OpenScene SweepScenes::open(const scene::Job& job)
{
    read(job);
    if (!loaded_scene_) {
        loaded_scene_.emplace(context_, file_->scene, options_);
    }
    return {file_.get(), &loaded_scene_->renderers()};
}

} // namespace gnomon::api
