/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The export formats for MeshLab from 2022.02 on (IOPlugin). */
#ifndef FS_MESHLAB_FORMATS_2021_H
#define FS_MESHLAB_FORMATS_2021_H

#include <common/plugins/interfaces/io_plugin.h>

class FairsurfFormats : public QObject, public IOPlugin {
  Q_OBJECT
  MESHLAB_PLUGIN_IID_EXPORTER(IO_PLUGIN_IID)
  Q_INTERFACES(IOPlugin)

public:
  QString pluginName() const override { return "IOFairsurf"; }
  QString vendor() const override { return "fairsurf"; }
  std::list<FileFormat> importFormats() const override { return {}; }
  std::list<FileFormat> exportFormats() const override;
  void exportMaskCapability(const QString &format, int &capability, int &defaultBits) const override;
  RichParameterList initSaveParameter(const QString &format, const MeshModel &) const override;
  void open(const QString &format, const QString &, MeshModel &, int &, const RichParameterList &,
            vcg::CallBackPos *) override {
    wrongOpenFormat(format);
  }
  void save(const QString &format, const QString &path, MeshModel &model, const int mask, const RichParameterList &list,
            vcg::CallBackPos *callback) override;
};

#endif
