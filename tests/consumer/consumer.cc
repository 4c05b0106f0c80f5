// A C++17 program that uses the engine as an installed library is used.
//
// Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

#include <bight/bight.h>

#include <cmath>
#include <iostream>
#include <string>

int
main ()
{
  bt_error error{};
  bt_catenary c{};

  // A symmetric line of 10 m across 6 m: 2 a sinh (h / 2a) = s.
  if (bt_catenary_solve (6.0, 0.0, 10.0, &c, &error) != BT_OK)
    {
      std::cerr << "consumer: " << error.text << '\n';
      return 1;
    }
  const double length = 2.0 * c.a * std::sinh (3.0 / c.a);
  if (std::abs (length - 10.0) > 1e-9)
    {
      std::cerr << "consumer: length " << length << '\n';
      return 1;
    }

  const bt_status status = bt_catenary_solve (-1.0, 0.0, 10.0, &c, &error);
  if (status != BT_ERR_DOMAIN || bt_status_name (status) != std::string ("domain"))
    {
      std::cerr << "consumer: a negative distance gave `" << bt_status_name (status) << "'\n";
      return 1;
    }
  std::cout << "bight " << bt_version () << '\n';
}
