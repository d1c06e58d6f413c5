#pragma once

#define CAROM_VERSION "0.1.0"
