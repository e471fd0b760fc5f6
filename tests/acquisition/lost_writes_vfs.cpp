// SPDX-License-Identifier: BSD-3-Clause
// The layer over SQLite's default file system: an image of the whole file in memory, written down at each sync.
#include "tests/acquisition/lost_writes_vfs.hpp"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <new>
#include <vector>

namespace gonio::acquisition::test {
namespace {

bool has_power = true;

/// What SQLite holds as an open file; `real` lies behind it in the same block of memory.
struct File {
  sqlite3_file base;
  std::vector<char>* image;  ///< as the program sees the file
  sqlite3_file* real;        ///< as the disk holds it
};

File* as_file(sqlite3_file* f) { return reinterpret_cast<File*>(f); }
sqlite3_file* real(sqlite3_file* f) { return as_file(f)->real; }
sqlite3_vfs* real_vfs(sqlite3_vfs* vfs) { return static_cast<sqlite3_vfs*>(vfs->pAppData); }

int close(sqlite3_file* f) {
  delete as_file(f)->image;
  return real(f)->pMethods->xClose(real(f));
}

int read(sqlite3_file* f, void* buffer, int amount, sqlite3_int64 offset) {
  const auto& image = *as_file(f)->image;
  const auto size = static_cast<sqlite3_int64>(image.size());
  const auto there = static_cast<std::size_t>(std::clamp<sqlite3_int64>(size - offset, 0, amount));
  if (there > 0) std::memcpy(buffer, image.data() + offset, there);
  std::memset(static_cast<char*>(buffer) + there, 0, static_cast<std::size_t>(amount) - there);
  return there == static_cast<std::size_t>(amount) ? SQLITE_OK : SQLITE_IOERR_SHORT_READ;
}

int write(sqlite3_file* f, const void* data, int amount, sqlite3_int64 offset) {
  auto& image = *as_file(f)->image;
  image.resize(std::max(image.size(), static_cast<std::size_t>(offset) + static_cast<std::size_t>(amount)));
  std::memcpy(image.data() + offset, data, static_cast<std::size_t>(amount));
  return SQLITE_OK;
}

int truncate(sqlite3_file* f, sqlite3_int64 size) {
  as_file(f)->image->resize(static_cast<std::size_t>(size));
  return SQLITE_OK;
}

int sync(sqlite3_file* f, int flags) {
  if (!has_power) return SQLITE_OK;
  const auto& image = *as_file(f)->image;
  const auto size = static_cast<sqlite3_int64>(image.size());
  if (const int code = real(f)->pMethods->xTruncate(real(f), size); code != SQLITE_OK) return code;
  constexpr sqlite3_int64 piece = 65536;  // the default layer takes less than 128 KiB at once
  for (sqlite3_int64 k = 0; k < size; k += piece) {
    const int code = real(f)->pMethods->xWrite(real(f), image.data() + k, static_cast<int>(std::min(piece, size - k)), k);
    if (code != SQLITE_OK) return code;
  }
  return real(f)->pMethods->xSync(real(f), flags);
}

int file_size(sqlite3_file* f, sqlite3_int64* size) {
  *size = static_cast<sqlite3_int64>(as_file(f)->image->size());
  return SQLITE_OK;
}

int lock(sqlite3_file* f, int level) { return real(f)->pMethods->xLock(real(f), level); }
int unlock(sqlite3_file* f, int level) { return real(f)->pMethods->xUnlock(real(f), level); }
int check_lock(sqlite3_file* f, int* out) { return real(f)->pMethods->xCheckReservedLock(real(f), out); }
int control(sqlite3_file* f, int op, void* argument) {
  // The hint would write around the image.
  return op == SQLITE_FCNTL_SIZE_HINT ? SQLITE_NOTFOUND : real(f)->pMethods->xFileControl(real(f), op, argument);
}
int sector_size(sqlite3_file* f) { return real(f)->pMethods->xSectorSize(real(f)); }
int characteristics(sqlite3_file*) { return 0; }

const sqlite3_io_methods methods{1,       close,      read,    write,       truncate,        sync,    file_size, lock,
                                 unlock,  check_lock, control, sector_size, characteristics, nullptr, nullptr,   nullptr,
                                 nullptr, nullptr,    nullptr};

int open(sqlite3_vfs* vfs, const char* path, sqlite3_file* out, int flags, int* out_flags) {
  File* file = as_file(out);
  file->base.pMethods = nullptr;
  file->real = reinterpret_cast<sqlite3_file*>(file + 1);
  if (const int code = real_vfs(vfs)->xOpen(real_vfs(vfs), path, file->real, flags, out_flags); code != SQLITE_OK) return code;
  sqlite3_int64 size = 0;
  file->real->pMethods->xFileSize(file->real, &size);
  file->image = new std::vector<char>(static_cast<std::size_t>(size));
  if (size > 0) file->real->pMethods->xRead(file->real, file->image->data(), static_cast<int>(size), 0);
  file->base.pMethods = &methods;
  return SQLITE_OK;
}

int remove(sqlite3_vfs* vfs, const char* path, int sync_folder) {
  return has_power ? real_vfs(vfs)->xDelete(real_vfs(vfs), path, sync_folder) : SQLITE_OK;
}

sqlite3_vfs layer{};
std::string layer_name = LostWritesVfs::name();

}  // namespace

LostWritesVfs::LostWritesVfs() {
  has_power = true;
  sqlite3_vfs* original = sqlite3_vfs_find(nullptr);
  layer = *original;
  layer.pNext = nullptr;
  layer.zName = layer_name.c_str();
  layer.pAppData = original;
  layer.szOsFile = static_cast<int>(sizeof(File)) + original->szOsFile;
  layer.xOpen = open;
  layer.xDelete = remove;
  sqlite3_vfs_register(&layer, 0);
}

LostWritesVfs::~LostWritesVfs() { sqlite3_vfs_unregister(&layer); }

void LostWritesVfs::lose_power() { has_power = false; }

}  // namespace gonio::acquisition::test
