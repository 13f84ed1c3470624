#include "route/plan.h"

#include "scene/camera/camera.h"
#include "scene/scene.h"

namespace nephroid {

CompiledPlan compile_plan(const RoutePlan& plan, const Scene& scene) {
  const auto symbols =
      std::make_shared<const SceneSymbols>(scene, mentioned_labels(plan.routes, plan.aovs));
  return {symbols,
          compile_routes(plan.routes, plan.aovs, &symbols->present(), scene.camera->connects()),
          plan.strict, plan.has_own_routes};
}

}  // namespace nephroid
