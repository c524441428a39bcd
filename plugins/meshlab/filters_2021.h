/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The filters for MeshLab from 2022.02 on (FilterPlugin). */
#ifndef FS_MESHLAB_FILTERS_2021_H
#define FS_MESHLAB_FILTERS_2021_H

#include <common/plugins/interfaces/filter_plugin.h>

class FairsurfFilters : public QObject, public FilterPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
  Q_INTERFACES(FilterPlugin)

public:
  FairsurfFilters();
  QString pluginName() const override { return "FilterFairsurf"; }
  QString vendor() const override { return "fairsurf"; }
  QString filterName(ActionIDType id) const override;
  QString pythonFilterName(ActionIDType id) const override;
  QString filterInfo(ActionIDType id) const override;
  FilterClass getClass(const QAction *action) const override;
  FilterArity filterArity(const QAction *) const override { return SINGLE_MESH; }
  int getPreConditions(const QAction *) const override { return MeshModel::MM_FACENUMBER; }
  int postCondition(const QAction *action) const override;
  RichParameterList initParameterList(const QAction *action, const MeshModel &) override;
  std::map<std::string, QVariant> applyFilter(const QAction *action, const RichParameterList &list,
                                              MeshDocument &document, unsigned int &postConditionMask,
                                              vcg::CallBackPos *callback) override;
};

#endif
