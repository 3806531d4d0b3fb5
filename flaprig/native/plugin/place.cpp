// Where an instance sits: its body, and the site that is the wing frame, whatever a model that
// attaches the wing has put around their names.

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "../reader.hpp"
#include "instance.hpp"

namespace flaprig {
namespace {

int body_of(const mjModel* m, int instance) {
  int body = -1;
  for (int b = 0; b < m->nbody; ++b) {
    if (m->body_plugin[b] != instance) continue;
    if (body >= 0) {
      throw std::invalid_argument("the instance is attached to two bodies; give each wing its own");
    }
    body = b;
  }
  if (body < 0) throw std::invalid_argument("the instance is attached to no body");
  return body;
}

struct Site {
  int id;
  std::string_view name;
};
using Sites = std::vector<Site>;

// mj_name2id is not to be used here: it needs the hash map, which is made later
Sites sites_of(const mjModel* m, int body) {
  Sites sites;
  for (int s = 0; s < m->nsite; ++s) {
    if (m->site_bodyid[s] == body) sites.push_back({s, m->names + m->name_siteadr[s]});
  }
  return sites;
}

template <class Is>
Sites those(const Sites& sites, Is is) {
  Sites found;
  std::copy_if(sites.begin(), sites.end(), std::back_inserter(found), is);
  return found;
}

// what stands around the wanted text, where it is in the name: the prefix and the suffix of an attach
bool around(std::string_view name, std::string_view wanted, std::string_view* prefix,
            std::string_view* suffix) {
  const size_t at = name.rfind(wanted);
  if (at == name.npos) return false;
  *prefix = name.substr(0, at), *suffix = name.substr(at + wanted.size());
  return true;
}

bool starts(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

bool ends(std::string_view text, std::string_view with) {
  return text.size() >= with.size() && text.substr(text.size() - with.size()) == with;
}

// Attaching puts the same prefix and suffix around all names of a model, but cannot know that an
// attribute is one. So the exact name comes first; then what has around it what the instance has
// too; then a prefix, a suffix, both.
Sites candidates(const Sites& sites, std::string_view wanted, std::string_view instance) {
  Sites found = those(sites, [&](const Site& s) { return s.name == wanted; });
  std::string_view prefix, suffix;
  if (found.empty()) {
    found = those(sites, [&](const Site& s) {
      return around(s.name, wanted, &prefix, &suffix) && starts(instance, prefix) &&
             ends(instance, suffix);
    });
  }
  if (found.empty()) found = those(sites, [&](const Site& s) { return ends(s.name, wanted); });
  if (found.empty()) found = those(sites, [&](const Site& s) { return starts(s.name, wanted); });
  if (found.empty()) {
    found = those(sites, [&](const Site& s) { return around(s.name, wanted, &prefix, &suffix); });
  }
  return found;
}

std::string listed(const Sites& sites) {
  std::string text;
  for (const Site& s : sites) {
    text += (text.empty() ? "" : ", ") + (s.name.empty() ? "one without a name" : quoted(std::string(s.name)));
  }
  return text.empty() ? "has none" : "has " + text;
}

}  // namespace

Place place_of(const mjModel* m, int instance, const PlateSettings& plate) {
  const int body = body_of(m, instance);
  const std::string owner = quoted(m->names + m->name_bodyadr[body]);
  const Sites sites = sites_of(m, body);
  if (plate.site.empty()) {
    if (sites.size() == 1) return {body, sites[0].id, {}};
    throw std::invalid_argument(
        "site must be given: the name of a site on the wing's body whose x axis points along the "
        "chord from leading to trailing edge, y along the span, z along the normal; body " +
        owner + " " + listed(sites));
  }
  const Sites found = candidates(sites, plate.site, m->names + m->name_pluginadr[instance]);
  if (found.size() == 1) return {body, found[0].id, {}};
  if (found.empty() && sites.size() == 1) {
    return {body, sites[0].id,
            "body " + owner + " has no site " + quoted(plate.site) + "; its only one, " +
                quoted(std::string(sites[0].name)) + ", is taken as the wing frame"};
  }
  throw std::invalid_argument("site must be one that fits alone, and body " + owner + " " +
                              listed(sites) + ": site must be the name of a site on the wing's own "
                              "body, got " + quoted(plate.site));
}

}  // namespace flaprig
