// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The eigengrasp authors
// Files beside a GraspIt! robot: eigengrasps and virtual contacts.
#include "model_io/graspit_robot.hpp"
#include "model_io/text_values.hpp"

namespace eigengrasp {

namespace {

/// The vector that the attributes d0, d1, ... of <DimVals> name; what is not named is 0.
VecX read_dim_values(const XmlElement& eigengrasp, const HandModel& hand) {
  VecX values = VecX::Zero(hand.n_dof());
  for (const XmlElement& dim_values : eigengrasp.children("DimVals")) {
    for (const std::string& name : dim_values.attribute_names()) {
      const auto index = name[0] == 'd' ? parse_integer(std::string_view(name).substr(1)) : std::nullopt;
      if (!index || *index < 0 || *index >= hand.n_dof()) {
        dim_values.fail("<DimVals> names \"{}\", expected d0 to d{}, one a degree of freedom of {}",
                        shown(name), hand.n_dof() - 1, hand.name);
      }
      values[*index] = dim_values.require_attribute_number(name.c_str());
    }
  }
  return values;
}

Eigengrasp read_eigengrasp(const XmlElement& element, const HandModel& hand, std::size_t number) {
  Eigengrasp e;
  e.name = fmt::format("eigengrasp {}", number);
  e.direction = read_dim_values(element, hand);
  if (const XmlElement limits = element.child("Limits")) {
    e.min = limits.require_attribute_number("min");
    e.max = limits.require_attribute_number("max");
    if (e.min > e.max) {
      limits.fail("<Limits>: min is \"{}\", expected at most max, {}", limits.require_attribute("min"),
                  limits.require_attribute("max"));
    }
  }
  return e;
}

VirtualContact read_contact(const XmlElement& element, const GraspitRobot& robot) {
  const XmlElement finger = element.require_child("finger_number");
  const XmlElement link = element.require_child("link_number");
  GraspitRobot::LinkFrame frame;  // the palm
  const int f = finger.integer();
  if (f >= 0) {
    const int n_chains = static_cast<int>(robot.chains.size());
    if (f >= n_chains) {
      finger.fail("<finger_number> is \"{}\", expected -1 (the palm) to {}", f, n_chains - 1);
    }
    const auto& links = robot.chains[static_cast<std::size_t>(f)];
    const int l = link.integer();
    if (l < 0 || l >= static_cast<int>(links.size())) {
      link.fail("<link_number> is \"{}\", expected 0 to {}", l, links.size() - 1);
    }
    frame = links[static_cast<std::size_t>(l)];
  } else if (f != -1) {
    finger.fail("<finger_number> is \"{}\", expected -1 (the palm) or the number of a chain", f);
  }
  const XmlElement normal = element.require_child("normal");
  if (normal.vector().norm() < 1e-6) {
    normal.fail("<normal> is \"{}\", expected a direction that is not zero", shown(normal.text()));
  }
  return {frame.link, frame.X_LG * (metres_of_mm * element.require_child("location").vector()),
          (frame.X_LG.linear() * normal.vector()).normalized()};
}

}  // namespace

EigengraspSpace read_graspit_eigengrasps(const std::filesystem::path& file, const HandModel& hand) {
  const XmlFile xml(file);
  const XmlElement root = xml.require_root("EigenGrasps");
  if (root.attribute("dimensions") && root.require_attribute_number("dimensions") != hand.n_dof()) {
    root.fail("dimensions is \"{}\", expected {}, the number of degrees of freedom of {}",
              root.require_attribute("dimensions"), hand.n_dof(), hand.name);
  }
  std::vector<Eigengrasp> eigengrasps;
  for (const XmlElement& element : root.children("EG")) {
    eigengrasps.push_back(read_eigengrasp(element, hand, eigengrasps.size() + 1));
  }
  if (eigengrasps.empty()) root.fail("<EigenGrasps> has no <EG>, expected at least one");
  VecX origin = VecX::Zero(hand.n_dof());
  if (const XmlElement element = root.child("ORIGIN")) origin = read_dim_values(element, hand);
  try {
    return EigengraspSpace(origin, std::move(eigengrasps));
  } catch (const Error& e) {
    root.fail("{}", e.what());
  }
}

void read_graspit_contacts(const std::filesystem::path& file, GraspitRobot& out) {
  const XmlFile xml(file);
  const XmlElement root = xml.require_root("virtual_contacts");
  const auto contacts = root.children("virtual_contact");
  if (const XmlElement count = root.child("num_contacts")) {
    if (count.integer() != static_cast<int>(contacts.size())) {
      count.fail("<num_contacts> is \"{}\", but the file holds {}, expected as many", count.integer(),
                 contacts.size());
    }
  }
  for (const XmlElement& contact : contacts) {
    out.hand.virtual_contacts.push_back(read_contact(contact, out));
  }
}

}  // namespace eigengrasp
