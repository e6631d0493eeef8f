// SPDX-License-Identifier: Zlib
#include "cairn/effects/effect_set.h"

#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <BulletDynamics/Dynamics/btRigidBody.h>

#include <algorithm>
#include <cassert>
#include <functional>
#include <utility>

#include "acting_effect.h"
#include "blow_order.h"
#include "contact_work.h"
#include "motion_meter.h"
#include "side_book.h"
#include "solver_hook.h"
#include "step_contacts.h"

namespace cairn::effects {
namespace {

// Bullet says to nobody who owns a world's solver; naming a protected member through a derived class is how C++ lets
// one look.
struct WorldsSolver : btDiscreteDynamicsWorld {
  static bool isOwnedBy(const btDiscreteDynamicsWorld& world) { return world.*&WorldsSolver::m_ownsConstraintSolver; }
};

}  // namespace

class EffectSet::Impl final : public SolveListener {
 public:
  explicit Impl(btDiscreteDynamicsWorld& world) : world_(world), hook_(*world.getConstraintSolver(), *this) {
    world_.setConstraintSolver(&hook_);
  }
  ~Impl() override {
    assert(world_.getConstraintSolver() == &hook_ && "another solver was set while effects were at work");
    while (!bodies_.empty()) removeBody(*bodies_.back()->body);
    if (world_.getConstraintSolver() == &hook_) world_.setConstraintSolver(&hook_.solver());
  }

  Status canAct(const Effect& effect) const {
    if (effect.turn() != Turn::rollingResistance || hook_.canResist()) return {};
    return Error{
        "rolling resistance needs a world whose solver is a btSequentialImpulseConstraintSolver itself or an "
        "OrderedSolver of it: make the world with one of these"};
  }

  void add(std::unique_ptr<Effect> effect) {
    assert(!isInHook_);
    ActingEffect& added = *effects_.emplace_back(std::make_unique<ActingEffect>(std::move(effect)));
    const auto turn = [](ActingEffect* acting) { return acting->effect().turn(); };
    turns_.insert(std::ranges::upper_bound(turns_, turn(&added), {}, turn), &added);
    for (const auto& body : bodies_) added.effect().welcome(*body);
    const Hooks& hooks = added.hooks();
    wanted_.add(hooks);
    wantsBodies_ = wantsBodies_ || hooks.force != nullptr;
  }

  std::uint32_t addBody(btRigidBody& body, const Traits& traits) {
    assert(!isInHook_ && !body.isStaticOrKinematicObject() && traits.volume >= 0 && book_.find(body) == nullptr);
    bodies_.push_back(std::make_unique<Body>(&body, traits, nextId_));
    book_.enter(body, *bodies_.back());
    for (ActingEffect* acting : turns_) acting->effect().welcome(*bodies_.back());
    return nextId_++;
  }

  void removeBody(btRigidBody& body) {
    assert(!isInHook_);
    const auto found = std::ranges::find_if(bodies_, [&](const auto& known) { return known->body == &body; });
    if (found == bodies_.end()) return;
    for (ActingEffect* acting : turns_) acting->effect().dismiss(**found);
    forget(body);
    bodies_.erase(found);
  }

  void describe(const btCollisionObject& object, const Traits& traits) { book_.enter(object, traits); }

  void forget(const btCollisionObject& object) {
    book_.strike(object);
    contacts_.forgetBlowsOf(object);
  }

  std::vector<EffectReport> report() const {
    std::vector<EffectReport> reports;
    for (const auto& acting : effects_) reports.push_back(acting->report());
    return reports;
  }

  void beforeSolve() override {
    if (effects_.empty()) return;
    isInHook_ = true;
    step_.timeStep = world_.getSolverInfo().m_timeStep;
    step_.gravity = world_.getGravity();
    applyForces();
    changeContacts();
  }

  void afterSolve() override {
    if (effects_.empty()) return;
    bookContacts();
    order_.restore();
    for (ActingEffect* acting : turns_) acting->restoreContacts(contacts_.contacts());
    const std::span<const Impact> impacts = contacts_.finish();
    applyImpacts(impacts);
    for (ActingEffect* acting : turns_) acting->noteImpacts(impacts, step_);
    ++step_.number;
    isInHook_ = false;
  }

 private:
  void applyForces() {
    if (!wantsBodies_) return;
    awake_.clear();
    for (const auto& body : bodies_)
      if (body->body->isActive()) awake_.push_back(body.get());
    meter_.watch(awake_);
    for (ActingEffect* acting : turns_)
      if (acting->applyForces(awake_, step_) > 0) acting->book(meter_.lookAgain());
  }

  void applyImpacts(std::span<const Impact> impacts) {
    if (std::ranges::none_of(turns_, [](const ActingEffect* acting) { return acting->hooks().impact != nullptr; }))
      return;
    meter_.watchStruck(impacts);
    for (ActingEffect* acting : turns_)
      if (acting->afterImpacts(impacts, step_) > 0) acting->book(meter_.lookAgain());
  }

  void changeContacts() {
    contacts_.gather(*world_.getDispatcher(), book_, wanted_);
    for (ActingEffect* acting : turns_) acting->changeContacts(contacts_.contacts(), step_);
    order_.arrange(contacts_.contacts(), step_);
    resistances_.clear();
    for (const Contact& contact : contacts_.contacts()) {
      if (!(contact.rollingLength > 0 || contact.spinningLength > 0)) continue;
      if (hook_.canResist())
        resistances_.push_back({contact.point, contact.rollingLength, contact.spinningLength, &contact, {}});
      else
        leaveToBullet(contact);
    }
    std::ranges::sort(resistances_, std::less<>{}, &Resistance::point);
    hook_.resist(resistances_);
  }

  // Whose rows resist less than they should, but do resist.
  static void leaveToBullet(const Contact& contact) {
    contact.point->m_combinedRollingFriction = contact.rollingLength;
    contact.point->m_combinedSpinningFriction = contact.spinningLength;
  }

  // Whose work it is, null if nobody's.
  ActingEffect* answererOf(Answer answer, const Contact& contact) const {
    const auto found = std::find_if(turns_.rbegin(), turns_.rend(), [&](const ActingEffect* acting) {
      return acting->answers(answer, contact.sides[0].material, contact.sides[1].material);
    });
    return found == turns_.rend() ? nullptr : *found;
  }

  void bookContacts() {
    for (const Contact& contact : contacts_.contacts()) {
      if (!wasAtWork(contact)) continue;
      ActingEffect *friction = answererOf(Answer::friction, contact),
                   *restitution = answererOf(Answer::restitution, contact);
      if (friction == nullptr && restitution == nullptr) continue;
      const ContactWork work(contact);
      if (friction != nullptr) friction->book(work.along);
      if (restitution != nullptr) restitution->book(work.across);
    }
    // Sums must not go by addresses of points.
    std::ranges::sort(resistances_, std::less<>{}, &Resistance::contact);
    for (const Resistance& resistance : resistances_)
      if (ActingEffect* rolling = answererOf(Answer::rolling, *resistance.contact)) rolling->book(resistance.work);
  }

  btDiscreteDynamicsWorld& world_;
  SolverHook hook_;
  std::vector<std::unique_ptr<ActingEffect>> effects_;  // in the order they came
  std::vector<ActingEffect*> turns_;                    // in the order they act
  std::vector<std::unique_ptr<Body>> bodies_;           // in the order they came
  std::uint32_t nextId_ = 0;
  SideBook book_;
  StepContacts contacts_;
  BlowOrder order_;
  std::vector<Body*> awake_;
  std::vector<Resistance> resistances_;
  MotionMeter meter_;
  Step step_;
  WantedContacts wanted_;
  bool wantsBodies_ = false, isInHook_ = false;
};

Result<std::unique_ptr<EffectSet>> EffectSet::create(btDiscreteDynamicsWorld& world) {
  if (WorldsSolver::isOwnedBy(world))
    return Error{"the world made its solver itself and would free it; give it one when you make it"};
  if (world.getConstraintSolver()->getSolverType() == BT_MULTIBODY_SOLVER)
    return Error{
        "effects act on rigid bodies, and a multibody world keeps another solver; use a btDiscreteDynamicsWorld"};
  return std::unique_ptr<EffectSet>(new EffectSet(std::make_unique<Impl>(world)));
}

EffectSet::EffectSet(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
EffectSet::~EffectSet() = default;

Status EffectSet::canAct(const Effect& effect) const {
  return impl_->canAct(effect);
}
void EffectSet::add(std::unique_ptr<Effect> effect) {
  impl_->add(std::move(effect));
}
std::uint32_t EffectSet::addBody(btRigidBody& body, const Traits& traits) {
  return impl_->addBody(body, traits);
}
void EffectSet::removeBody(btRigidBody& body) {
  impl_->removeBody(body);
}
void EffectSet::describe(const btCollisionObject& object, const Traits& traits) {
  impl_->describe(object, traits);
}
void EffectSet::forget(const btCollisionObject& object) {
  impl_->forget(object);
}
std::vector<EffectReport> EffectSet::report() const {
  return impl_->report();
}

}  // namespace cairn::effects
