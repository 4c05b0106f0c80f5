/* Search in the manual's pages: every word must be in a section; those with the words in their title first.
   Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.  */
(function () {
  var pages = window.bightPages || [], box = document.getElementById("search");
  if (!box) return;
  var field = box.querySelector("input"), list = box.querySelector("ol");
  function words () { return field.value.toLowerCase ().split (/\s+/).filter (Boolean); }
  function rank (page, all) {
    var title = page[1].toLowerCase (), text = page[2].toLowerCase (), sum = 0;
    for (var i = 0; i < all.length; i++) {
      if (title.indexOf (all[i]) >= 0) sum += 10;
      else if (text.indexOf (all[i]) >= 0) sum += 1;
      else return 0;
    }
    return sum;
  }
  function excerpt (text, word) {
    var at = Math.max (0, text.toLowerCase ().indexOf (word)), from = Math.max (0, at - 60);
    var small = document.createElement ("small"), mark = document.createElement ("mark");
    small.append (text.slice (from, at));
    mark.textContent = text.slice (at, at + word.length);
    small.append (mark, text.slice (at + word.length, at + 100));
    return small;
  }
  function show () {
    var all = words ();
    list.textContent = "";
    if (!all.length) return;
    pages.map (function (p) { return [rank (p, all), p]; })
      .filter (function (f) { return f[0] > 0; })
      .sort (function (a, b) { return b[0] - a[0]; })
      .slice (0, 12)
      .forEach (function (f) {
        var item = document.createElement ("li"), link = document.createElement ("a");
        link.href = f[1][0];
        link.textContent = f[1][1];
        item.append (link, excerpt (f[1][2], all[0]));
        list.append (item);
      });
  }
  field.addEventListener ("input", show);
  document.addEventListener ("keydown", function (e) {
    if (e.key === "/" && document.activeElement !== field) { e.preventDefault (); field.focus (); }
  });
}) ();
