/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The export formats for MeshLab up to 2020.09 (MeshIOInterface). */
#ifndef FS_MESHLAB_FORMATS_2020_H
#define FS_MESHLAB_FORMATS_2020_H

#include <common/interfaces.h>

class FairsurfFormats : public QObject, public MeshIOInterface {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(MESH_IO_INTERFACE_IID)
  Q_INTERFACES(MeshIOInterface)

public:
  QString pluginName() const override { return "IOFairsurf"; }
  QList<Format> importFormats() const override { return {}; }
  QList<Format> exportFormats() const override;
  void GetExportMaskCapability(QString &format, int &capability, int &defaultBits) const override;
  void initSaveParameter(const QString &format, MeshModel &, RichParameterList &list) override;
  bool open(const QString &, const QString &, MeshModel &, int &, const RichParameterList &, vcg::CallBackPos *,
            QWidget *) override {
    return false;
  }
  bool save(const QString &format, const QString &path, MeshModel &model, const int mask, const RichParameterList &list,
            vcg::CallBackPos *callback, QWidget *parent) override;
};

#endif
