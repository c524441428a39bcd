/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The filters for MeshLab up to 2020.09 (MeshFilterInterface). */
#ifndef FS_MESHLAB_FILTERS_2020_H
#define FS_MESHLAB_FILTERS_2020_H

#include <common/interfaces.h>

class FairsurfFilters : public QObject, public MeshFilterInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
  Q_INTERFACES(MeshFilterInterface)

public:
  FairsurfFilters();
  QString pluginName() const override { return "FilterFairsurf"; }
  QString filterName(FilterIDType id) const override;
  QString filterInfo(FilterIDType id) const override;
  FilterClass getClass(QAction *action) override;
  FILTER_ARITY filterArity(QAction *) const override { return SINGLE_MESH; }
  int getPreConditions(QAction *) const override { return MeshModel::MM_FACENUMBER; }
  int postCondition(QAction *action) const override;
  void initParameterSet(QAction *action, MeshModel &, RichParameterList &list) override;
  bool applyFilter(QAction *action, MeshDocument &document, const RichParameterList &list,
                   vcg::CallBackPos *callback) override;
};

#endif
