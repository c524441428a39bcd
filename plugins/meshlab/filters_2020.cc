/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Single role: the table of filters in the shape that MeshLab up to 2020.09 asks for. */
#include "filters_2020.h"
#include "border.h"

FairsurfFilters::FairsurfFilters() {
  for (int i = 0; filters[i] != nullptr; i++) {
    typeList << i;
    actionList << new QAction(filterName(i), this);
  }
}

QString FairsurfFilters::filterName(FilterIDType id) const { return filters[id]->name; }
QString FairsurfFilters::filterInfo(FilterIDType id) const { return filters[id]->help; }

MeshFilterInterface::FilterClass FairsurfFilters::getClass(QAction *action) {
  static const int classes[] = {Remeshing | Polygonal, Smoothing | Polygonal, Quality | VertexColoring};
  return FilterClass(classes[filters[ID(action)]->menu]);
}

int FairsurfFilters::postCondition(QAction *action) const {
  int colours = MeshModel::MM_VERTQUALITY | MeshModel::MM_VERTCOLOR;
  return filters[ID(action)]->only_colours ? colours : colours | MeshModel::MM_GEOMETRY_AND_TOPOLOGY_CHANGE;
}

void FairsurfFilters::initParameterSet(QAction *action, MeshModel &, RichParameterList &list) {
  fairsurf::addParams(filters[ID(action)]->params, list);
}

bool FairsurfFilters::applyFilter(QAction *action, MeshDocument &document, const RichParameterList &list,
                                  vcg::CallBackPos *callback) {
  fairsurf::OutcomeOwner made;
  std::string failure = fairsurf::applyFilter(*filters[ID(action)], list, document, callback, made);
  if (!failure.empty()) errorMessage = QString::fromStdString(failure);
  Log("%s", failure.empty() ? made.log : failure.c_str()); // meshlabserver prints the log only
  return failure.empty();
}
