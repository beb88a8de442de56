#pragma once
/// A scene in MuJoCo, planar or in space: its model and its state.

#include <mujoco/mujoco.h>

#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>

namespace stylobate::peers {

class MujocoSimulation {
public:
    /// @param text of the model, in its XML
    /// @throws std::runtime_error with its words if it does not take the model
    explicit MujocoSimulation(const std::string& text)
    {
        const auto files = std::make_unique<mjVFS>();
        mj_defaultVFS(files.get());
        mj_makeEmptyFileVFS(files.get(), "scene.xml", static_cast<int>(text.size()));
        std::memcpy(files->filedata[mj_findFileVFS(files.get(), "scene.xml")], text.data(), text.size());
        char error[1000] = "";
        model_.reset(mj_loadXML("scene.xml", files.get(), error, sizeof error));
        mj_deleteVFS(files.get());
        if (!model_)
            throw std::runtime_error(std::string("MuJoCo does not take the scene: ") + error);
        data_.reset(mj_makeData(model_.get()));
    }

    /// The state, by MuJoCo's order of joints.
    mjtNum* positions() const { return data_->qpos; }
    mjtNum* velocities() const { return data_->qvel; }

    /// One step under this pull [m/s2].
    void step(double x, double y, double z)
    {
        mjtNum* const gravity = model_->opt.gravity;
        gravity[0] = x, gravity[1] = y, gravity[2] = z;
        mj_step(model_.get(), data_.get());
    }

private:
    struct Delete {
        void operator()(mjModel* model) const { mj_deleteModel(model); }
        void operator()(mjData* data) const { mj_deleteData(data); }
    };
    std::unique_ptr<mjModel, Delete> model_;
    std::unique_ptr<mjData, Delete> data_;
};

} // namespace stylobate::peers
