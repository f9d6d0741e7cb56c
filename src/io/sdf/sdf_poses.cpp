// sdf_poses.cpp -- reads the poses of a saved world.

#include "io/sdf/sdf_poses.h"

namespace insonify {

Pose pose_of(const sdf_math::Pose3d& pose) {
  const auto& p = pose.Pos();
  const auto& q = pose.Rot();
  return {{p.X(), p.Y(), p.Z()}, Eigen::Quaterniond(q.W(), q.X(), q.Y(), q.Z()).normalized()};
}

std::map<std::string, Pose> sdf_saved_poses(const sdf::World& world) {
  std::map<std::string, Pose> poses;
  if (!world.Element()->HasElement("state")) {
    return poses;
  }
  const sdf::ElementPtr state = world.Element()->GetElement("state");
  if (state->Get<std::string>("world_name") != world.Name()) {
    return poses;
  }
  for (sdf::ElementPtr model = state->HasElement("model") ? state->GetElement("model") : nullptr; model != nullptr;
       model = model->GetNextElement("model")) {
    if (model->HasElement("pose")) {
      poses[model->Get<std::string>("name")] = pose_of(model->Get<sdf_math::Pose3d>("pose"));
    }
  }
  return poses;
}

}  // namespace insonify
