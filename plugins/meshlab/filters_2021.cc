/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the table of filters in the shape that MeshLab from 2022.02 on asks for. */
#include "filters_2021.h"
#include "border.h"

FairsurfFilters::FairsurfFilters() {
  for (int i = 0; filters[i] != nullptr; i++) {
    typeList.push_back(i);
    actionList.push_back(new QAction(filterName(i), this));
  }
}

QString FairsurfFilters::filterName(ActionIDType id) const { return filters[id]->name; }
QString FairsurfFilters::pythonFilterName(ActionIDType id) const { return filters[id]->python_name; }
QString FairsurfFilters::filterInfo(ActionIDType id) const { return filters[id]->help; }

FilterPlugin::FilterClass FairsurfFilters::getClass(const QAction *action) const {
  static const int classes[] = {Remeshing | Polygonal, Smoothing | Polygonal, Quality | VertexColoring};
  return FilterClass(classes[filters[ID(action)]->menu]);
}

int FairsurfFilters::postCondition(const QAction *action) const {
  int colours = MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR;
  return filters[ID(action)]->only_colours ? colours : colours | MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE;
}

RichParameterList FairsurfFilters::initParameterList(const QAction *action, const MeshModel &) {
  RichParameterList list;
  fairsurf::addParams(filters[ID(action)]->params, list);
  return list;
}

std::map<std::string, QVariant> FairsurfFilters::applyFilter(const QAction *action, const RichParameterList &list,
                                                             MeshDocument &document, unsigned int &postConditionMask,
                                                             vcg::CallBackPos *callback) {
  std::map<std::string, QVariant> values;
  fairsurf::OutcomeOwner made;
  std::string failure = fairsurf::applyFilter(*filters[ID(action)], list, document, callback, made);
  if (!failure.empty()) throw MLException(QString::fromStdString(failure));
  postConditionMask = unsigned(postCondition(action));
  log("%s", made.log);
  for (int i = 0; i < made.n_values; i++) values[made.value[i].name] = QVariant(made.value[i].value);
  return values;
}
